// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/mapper.hpp"

#include <algorithm>
#include <utility>

#include "core/slam/information.hpp"
#include "core/slam/make_keyframe.hpp"

namespace topo::slam {

Mapper::Mapper(const MapperParams& params, const Origin& origin, const types::Se2& start)
    : params_(params),
      origin_(origin),
      start_(start),
      graph_(origin.robot, params.loop, params.graph),
      local_map_(params.keyframe, params.free_ground, params.refine.reach_m),
      open_questions_(0.5 * params.loop.search_floor_m, 0.5 * params.loop.search_floor_rad,
                      static_cast<std::size_t>(params.loop.group_half)),
      past_(params.past) {}

void Mapper::resume(const Session& session, const Arrival& arrival) {
  // The sequence continues: the key of the grow-only set never comes twice.
  for (std::size_t i = 0; i < session.keyframes.size(); ++i) {
    const KeyframeId& id = session.keyframes[i]->id;
    if (id.origin() == origin_) next_sequence_ = std::max(next_sequence_, id.sequence + 1);
    if (id.robot == origin_.robot)
      graph_.add_own(session.keyframes[i], session.poses[i]);
    else
      graph_.add_mates(session.keyframes[i], session.poses[i]);
  }
  for (const Edge& edge : session.edges)
    if (edge.finder.origin() == origin_) first_found_ = std::max(first_found_, edge.finder.sequence + 1);
  // Under this run only what has no finder: else the team's set of relations would grow by each restart.
  for (const Edge& edge : session.edges) {
    if (has_finder(edge))
      graph_.add(edge);
    else
      add_found_edge(edge);
  }
  solving_.asked = solving_.solved = graph_.edges().size();
  solving_.nodes = graph_.poses().size();
  const types::Se2& here = arrival.T_map_base;
  motion_.T_map_base = here;
  motion_.T_odom_base = arrival.T_odom_base;
  motion_.stamp = arrival.cloud.stamp;
  Edge edge;  // to the nearest keyframe
  std::vector<std::size_t> neighbours;
  const auto poses = graph_.poses();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double d = distance_m(poses[i], here);
    if (d < distance_m(poses[edge.from], here)) edge.from = i;
    if (d < params_.keyframe.resumed_m) neighbours.push_back(i);
  }
  edge.T_from_to = poses[edge.from].inverse() * here;
  edge.information = edge_information(arrival.information, here.theta_rad, params_.graph.loop_trans_floor_m,
                                      params_.graph.loop_rot_floor_rad);
  select_points(arrival.cloud, params_.cloud, points_);
  edge.to = graph_.add_own(keyframe_of(arrival.cloud, {}), here);
  add_found_edge(edge);
  local_map_.resume(graph_, here, std::move(neighbours));
}

MatchReport Mapper::add(const Cloud& cloud, const types::Se2& T_odom_base, walls::ColumnCollector& columns) {
  MatchReport report;
  report.stamp = cloud.stamp;
  report.T_odom_base = T_odom_base;
  select_points(cloud, params_.cloud, points_);
  if (graph_.keyframes().empty()) {
    motion_.T_map_base = report.T_map_base = start_;
    motion_.T_odom_base = T_odom_base;
    motion_.stamp = cloud.stamp;
    report.matched = true;
    report.keyframe = true;
    add_keyframe(cloud, report, {}, columns);
    return report;
  }
  const double seconds = types::to_seconds(cloud.stamp - motion_.stamp);
  const Prior prior = predict(motion_, T_odom_base, seconds, params_.motion);
  const Tracked tracked =
      track({local_map_.surfels(), [this] { return local_map_.ground(graph_); }}, {points_, cloud.sensor},
            motion_, prior, continued(motion_, seconds, params_.motion), params_);
  report.match = tracked.match;
  report.searched = tracked.searched;
  report.matched = tracked.kept && report.match.overlap > 0.0;
  report.T_map_base = report.matched ? report.match.T_map_base : prior.T_map_base;
  motion_ = {cloud.stamp, report.T_map_base, T_odom_base, motion_.T_map_base.inverse() * report.T_map_base,
             seconds};
  report.T_previous_base = motion_.T_previous_last;
  const types::Se2& newest = graph_.poses()[graph_.own().back()];
  const KeyframeParams& limits = params_.keyframe;
  const bool due = types::is_apart(newest, report.T_map_base, limits.travel_m, limits.turn_rad) ||
                   cloud.invalid_share < invalid_share_ - limits.unveiled_share;
  if (due && local_map_.has_enough_alike(graph_, report.T_map_base)) {
    columns.drop();
  } else if (due) {
    add_keyframe(cloud, report, prior, columns);
    report.keyframe = true;
  }
  report.node = graph_.own().back();
  report.T_node_base = graph_.poses()[report.node].inverse() * report.T_map_base;
  return report;
}

KeyframePtr Mapper::keyframe_of(const Cloud& cloud, std::vector<walls::ColumnPoint> columns) {
  return make_keyframe({origin_.robot, next_sequence_++, origin_.run}, cloud, points_, motion_.T_odom_base,
                       std::move(columns), params_.cloud);
}

void Mapper::add_keyframe(const Cloud& cloud, const MatchReport& report, const Prior& prior,
                          walls::ColumnCollector& columns) {
  const types::Se2& here = motion_.T_map_base;
  const bool first = graph_.own().empty();
  const std::size_t before = first ? 0 : graph_.own().back();
  const std::size_t node =
      graph_.add_own(keyframe_of(cloud, columns.take(motion_.T_odom_base.inverse())), here);
  invalid_share_ = cloud.invalid_share;
  if (!first) {
    Eigen::Matrix3d information = prior.information;
    if (report.matched) {
      information += report.match.scan_information;
    } else {
      const types::Se2& T_odom_before = graph_.keyframes()[before]->T_odom_base;
      information = motion_information(T_odom_before.inverse() * motion_.T_odom_base, params_.motion);
    }
    Edge edge;
    edge.from = before;
    edge.to = node;
    edge.T_from_to = graph_.poses()[before].inverse() * here;
    edge.information = edge_information(information, here.theta_rad, params_.graph.odometry_trans_floor_m,
                                        params_.graph.odometry_rot_floor_rad);
    add_found_edge(edge);
  }
  local_map_.extend(graph_, here);
  ask(node);
}

LoopQuery Mapper::query_about(std::size_t node) const {
  LoopQuery query;
  query.node = node;
  query.keyframe = graph_.keyframes()[node];
  query.pose = graph_.poses()[node];
  query.params = params_;
  return query;
}

void Mapper::ask(std::size_t node) {
  open_questions_.ask(node, graph_.poses()[node]);
  const auto own = graph_.own();
  const std::vector<double> distances_m = graph_.distances_m(node);
  const std::size_t end = graph_.end_of_past(own.size() - 1, distances_m, params_.loop);
  if (end == 0 && graph_.mates().empty()) return;
  LoopQuery query = query_about(node);
  query.groups = own_groups(graph_, node, end, distances_m, params_.loop);
  for (LoopGroup& group : mates_groups(graph_, node, distances_m, params_.loop))
    query.groups.push_back(std::move(group));
  if (!query.groups.empty()) query_ = std::move(query);
}

std::optional<LoopQuery> Mapper::take_query() { return std::exchange(query_, std::nullopt); }

std::optional<LoopQuery> Mapper::take_second_query() {
  const auto node = open_questions_.take();
  if (!node) return std::nullopt;
  open_questions_.ask(*node, graph_.poses()[*node]);
  const auto own = graph_.own();
  const auto place = static_cast<std::size_t>(std::lower_bound(own.begin(), own.end(), *node) - own.begin());
  const std::vector<double> distances_m = graph_.distances_m(*node);
  const std::size_t end = graph_.end_of_past(place, distances_m, params_.loop);
  LoopQuery query = query_about(*node);
  query.groups = own_groups(graph_, *node, end, distances_m, params_.loop);
  if (query.groups.empty()) return std::nullopt;
  return query;
}

std::vector<LoopQuery> Mapper::take_mate_queries(std::size_t count_max) {
  std::vector<LoopQuery> queries;
  while (queries.size() < count_max) {
    const auto node = intake_.take_untied(graph_);
    if (!node) break;
    LoopQuery query = query_about(*node);
    query.groups = own_groups(graph_, *node, graph_.own().size(), graph_.distances_m(*node), params_.loop);
    if (!query.groups.empty()) queries.push_back(std::move(query));
  }
  return queries;
}

std::optional<AlignmentQuery> Mapper::take_alignment_query() {
  if (auto query = intake_.take_alignment_query(graph_, params_)) return query;
  return past_.take(graph_, params_);
}

LoopVerdict Mapper::apply(const LoopAnswer& answer) {
  LoopVerdict verdict;
  for (const LoopCandidate& candidate : answer.candidates) {
    if (candidate.rejection != LoopRejection::kNone) {
      ++verdict.rejected;
      continue;
    }
    ++verdict.accepted;
    open_questions_.close(answer.node);
    if (!is_known(graph_.key_of(candidate.edge))) add_found_edge(candidate.edge);
  }
  return verdict;
}

JoinVerdict Mapper::join(std::span<const KeyframePtr> keyframes, std::span<const FoundRelation> relations) {
  return intake_.join(keyframes, relations, graph_);
}

JoinVerdict Mapper::relate(const RelationKey& key, const Relation& relation) {
  if (is_known(key)) return {};
  note_found(key, relation);
  const FoundRelation found = found_.back();
  return join({}, {&found, 1});
}

bool Mapper::is_known(const RelationKey& key) const { return graph_.has(key) || intake_.knows(key); }

void Mapper::add_found_edge(Edge edge) {
  edge.finder = note_found(graph_.key_of(edge), {edge.T_from_to, edge.information, edge.robust});
  graph_.add(edge);
}

KeyframeId Mapper::note_found(const RelationKey& key, const Relation& relation) {
  const auto number = first_found_ + static_cast<std::uint32_t>(found_.size());
  found_.push_back({{origin_.robot, number, origin_.run}, key, relation});
  return found_.back().id;
}

std::span<const FoundRelation> Mapper::found_since(std::uint32_t number) const {
  const std::size_t before = std::max(number, first_found_) - first_found_;
  return std::span(found_).subspan(std::min(before, found_.size()));
}

bool Mapper::has_new_closures() const {
  int closures = 0;
  for (const Edge& edge : graph_.edges().subspan(solving_.asked)) {
    closures += edge.robust ? 1 : 0;
    if (closures >= params_.graph.closures_before_solve || graph_.is_tense(edge)) return true;
  }
  return false;
}

GraphQuery Mapper::graph_query() const {
  return query_of(graph_.keyframes(), graph_.poses(), graph_.edges(), 0, params_.graph);
}

std::optional<GraphQuery> Mapper::take_graph_query() {
  if (solving_.out) return std::nullopt;
  const bool closures = has_new_closures();
  const bool keyframes = graph_.poses().size() >= solving_.nodes + params_.graph.keyframes_before_solve;
  if (!closures && !keyframes) return std::nullopt;
  solving_.nodes = graph_.poses().size();
  GraphQuery query = graph_query();
  if (!closures && query.headings.empty()) return std::nullopt;  // keyframes without walls change nothing
  solving_.out = true;
  solving_.asked = graph_.edges().size();
  return query;
}

std::vector<types::Se2> Mapper::corrected(const GraphSolution& solution) const {
  return corrected_poses(solution.poses, graph_.poses(), graph_.edges().subspan(solving_.asked));
}

void Mapper::adopt(std::vector<types::Se2> poses) {
  const std::size_t newest = graph_.own().back();
  const types::Se2 T_newest_base = graph_.poses()[newest].inverse() * motion_.T_map_base;
  graph_.move(std::move(poses));
  motion_.T_map_base = graph_.poses()[newest] * T_newest_base;
  solving_.out = false;
  solving_.solved = solving_.asked;
  open_questions_.correct(graph_.poses());
  local_map_.rebuild(graph_, motion_.T_map_base);
}

void Mapper::give_up_solving() {
  solving_.out = false;
  solving_.asked = solving_.solved;
}

SolveReport Mapper::optimise() {
  if (graph_.own().empty()) return {};
  solving_.asked = graph_.edges().size();
  solving_.nodes = graph_.poses().size();
  const GraphSolution solution =
      solve_settled(graph_.keyframes(), graph_.poses(), graph_.edges(), 0, params_.graph);
  adopt(solution.poses);
  return solution.report;
}

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/mapping_step.hpp"

#include <deque>
#include <limits>
#include <optional>

#include "core/pipeline/odometry_buffer.hpp"
#include "core/slam/map_builder.hpp"

namespace topo::pipeline {
namespace {

constexpr types::Duration kNewsWait = std::chrono::seconds(1);  ///< each change costs an analysis
constexpr std::size_t kMateQueries = 2;  ///< about team-mates' keyframes, at one keyframe boundary
/// Beams and columns that are drawn anew with one scan: a correction of everything that half an hour saw is
/// shown after some seconds.
constexpr std::size_t kRedrawnAScan = 6000;
/// What a correction left a little off is drawn when no other has come for a while: no more than a keyframe
/// with one scan, for nobody waits.
constexpr types::Duration kSettleAfter = std::chrono::seconds(5);
constexpr std::size_t kSettledAScan = 1;
constexpr std::size_t kWaiting = 16;  ///< scans that may wait for odometry: 0.4 s at 40 Hz

types::Stamp end_of(const types::Scan& scan) {
  return scan.first_beam + types::from_seconds(static_cast<double>(scan.geometry.time_increment_s) *
                                               (scan.beams > 0 ? scan.beams - 1 : 0));
}

/// Poses of base_link in odom at a scan's first and last beam.
struct SweepPoses {
  types::Se2 first, last;
};

}  // namespace

struct MappingState::Impl {
  Impl(const slam::MapperParams& given, const slam::Origin& origin, const types::Se2& start)
      : params(given), mapper(given, origin, start), builder(given.grid), columns(given.coronal) {}

  void take(const MappingInput& input);
  void push(std::deque<types::Scan>& waiting, const types::Scan& scan);
  bool ready(const types::Scan& scan, bool flush) const;
  std::optional<SweepPoses> sweep_poses(const types::Scan& scan) const;
  void run(MappingOutput& output, bool flush);
  void place_front(const types::Scan& scan, MappingOutput& output);
  void boundary(MappingOutput& output);
  void redraw();
  void settle();
  void draw(MappingOutput& output);
  [[nodiscard]] bool has_news() const {
    return !mates_keyframes.empty() || !mates_relations.empty() || !known.empty() || has_mates_answer ||
           mapper.has_mates_to_ask_about() || (correction && correction->drawn) || has_settled;
  }
  void join_news(MappingOutput& output);

  /// Corrected poses on the way into the map.
  struct Correction {
    slam::GraphSolution solution;
    std::vector<types::Se2> poses;  ///< of the keyframes that were there at the last boundary
    bool drawn = false;             ///< all of them
  };

  slam::MapperParams params;
  OdometryBuffer odometry;
  slam::Mapper mapper;
  slam::MapBuilder builder;
  std::optional<Correction> correction;
  bool is_settled = true;    ///< the shown map has every keyframe where it is, to the cell
  bool has_settled = false;  ///< since the last boundary
  std::optional<grid::OccupancyGrid> published;  ///< of the newest snapshot
  std::uint64_t changed_cells = 0;               ///< from the first snapshot to that one
  walls::ColumnCollector columns;
  std::deque<types::Scan> front, coronal;
  std::vector<slam::LoopAnswer> answers;
  bool has_mates_answer = false;  ///< one of them is about a team-mate's keyframe
  std::vector<slam::KeyframePtr> mates_keyframes;
  std::vector<slam::FoundRelation> mates_relations;
  std::vector<std::pair<slam::RelationKey, slam::Relation>> known;  ///< of where team-mates are
  slam::Cloud cloud;
  types::Stamp newest{};     ///< stamp of the newest scan heard of, either laser
  types::Stamp placed{};     ///< stamp of the newest front scan placed
  types::Stamp drawn{};      ///< the same, when the map was drawn last
  types::Stamp corrected{};  ///< the same, when a correction was shown last
  std::uint64_t revision = 0;
  MappingLosses losses;
};

void MappingState::Impl::take(const MappingInput& input) {
  for (const types::Odometry& sample : input.odometry) odometry.add(sample);
  if (input.coronal != nullptr) push(coronal, *input.coronal);
  if (input.front != nullptr) push(front, *input.front);
}

void MappingState::Impl::push(std::deque<types::Scan>& waiting, const types::Scan& scan) {
  if (odometry.empty()) {
    ++losses.without_odometry;
    return;
  }
  if (waiting.size() == kWaiting) {
    ++losses.queue_full;
    waiting.pop_front();
  }
  waiting.push_back(scan);
  newest = std::max(newest, end_of(scan));
}

bool MappingState::Impl::ready(const types::Scan& scan, bool flush) const {
  const types::Stamp end = end_of(scan);
  return flush || odometry.covers(end) || newest - end >= types::from_seconds(params.odometry_wait_s);
}

std::optional<SweepPoses> MappingState::Impl::sweep_poses(const types::Scan& scan) const {
  const auto first = odometry.at(scan.first_beam), last = odometry.at(end_of(scan));
  if (!first || !last) return std::nullopt;
  return SweepPoses{*first, *last};
}

void MappingState::Impl::run(MappingOutput& output, bool flush) {
  // Heights first: a keyframe takes along what was seen until then.
  while (!coronal.empty() && ready(coronal.front(), flush)) {
    if (const auto poses = sweep_poses(coronal.front()))
      columns.add(coronal.front(), poses->first, poses->last);
    coronal.pop_front();
  }
  while (!front.empty() && ready(front.front(), flush)) {
    place_front(front.front(), output);
    front.pop_front();
  }
}

void MappingState::Impl::place_front(const types::Scan& scan, MappingOutput& output) {
  const auto poses = sweep_poses(scan);
  if (!poses) return;
  const slam::SweepMotion motion{poses->last.inverse() * poses->first, {}};
  slam::make_cloud(scan, params.T_base_laser, motion, params.cloud, cloud);
  cloud.stamp = end_of(scan);
  placed = cloud.stamp;
  output.matches.push_back(mapper.add(cloud, poses->last, columns));
  redraw();
  // A robot that stands makes no keyframes, but its map grows by what others see and is corrected.
  if (output.matches.back().keyframe || (has_news() && placed - drawn >= kNewsWait)) boundary(output);
}

void MappingState::Impl::join_news(MappingOutput& output) {
  for (const auto& [key, relation] : known) output.joined += mapper.relate(key, relation);
  output.joined += mapper.join(mates_keyframes, mates_relations);
  known.clear();
  mates_keyframes.clear();
  mates_relations.clear();
}

void MappingState::Impl::boundary(MappingOutput& output) {
  if (auto query = mapper.take_query()) output.loop_queries.push_back(std::move(*query));
  for (const slam::LoopAnswer& answer : answers) output.loop_verdicts.push_back(mapper.apply(answer));
  answers.clear();
  has_mates_answer = false;
  if (has_news()) join_news(output);
  if (auto query = mapper.take_second_query()) output.loop_queries.push_back(std::move(*query));
  for (slam::LoopQuery& query : mapper.take_mate_queries(kMateQueries))
    output.loop_queries.push_back(std::move(query));
  if (auto query = mapper.take_alignment_query()) output.alignment_query = std::move(query);
  drawn = placed;
  has_settled = false;
  draw(output);
  if (auto query = mapper.take_graph_query()) output.graph_query = std::move(query);
  ++revision;
  output.keyframe_added = true;
}

void MappingState::Impl::redraw() {
  if (!correction) return settle();
  const auto keyframes = mapper.keyframes().first(correction->poses.size());
  correction->drawn = builder.prepare(keyframes, correction->poses, kRedrawnAScan);
}

void MappingState::Impl::settle() {
  if (is_settled || placed - corrected < kSettleAfter) return;
  is_settled = builder.settle(mapper.keyframes(), mapper.poses(), kSettledAScan);
  has_settled = is_settled;
}

/// What came since the last boundary, with corrected poses when the map is drawn with them.
void MappingState::Impl::draw(MappingOutput& output) {
  if (correction) correction->poses = mapper.corrected(correction->solution);
  if (!correction || !correction->drawn) {
    builder.extend(mapper.keyframes(), mapper.poses());
    return;
  }
  (void)builder.prepare(mapper.keyframes(), correction->poses, std::numeric_limits<std::size_t>::max());
  builder.show();
  mapper.adopt(std::move(correction->poses));
  correction.reset();
  corrected = placed;
  is_settled = has_settled = false;
  output.corrected = true;
}

MappingState::MappingState(const slam::MapperParams& params, const slam::Origin& origin,
                           const types::Se2& start)
    : impl_(std::make_unique<Impl>(params, origin, start)) {}
MappingState::MappingState(const slam::MapperParams& params, const slam::Session& session,
                           const slam::Arrival& arrival, const slam::Origin& origin)
    : MappingState(params, origin) {
  impl_->mapper.resume(session, arrival);
  impl_->cloud = arrival.cloud;
  impl_->placed = arrival.cloud.stamp;
  impl_->builder.update(impl_->mapper.keyframes(), impl_->mapper.poses());
}
MappingState::~MappingState() = default;

void MappingState::follow(std::uint64_t revision) { impl_->revision = revision + 1; }

void MappingState::adopt() { impl_->builder.adopt(); }

void MappingState::offer(slam::LoopAnswer answer) {
  const slam::Keyframe& asked = *impl_->mapper.keyframes()[answer.node];
  impl_->has_mates_answer = impl_->has_mates_answer || asked.id.robot != impl_->mapper.origin().robot;
  impl_->answers.push_back(std::move(answer));
}

void MappingState::offer(const slam::Alignment& alignment) {
  if (!alignment.found()) return;
  impl_->known.insert(impl_->known.end(), alignment.closures.begin(), alignment.closures.end());
}

void MappingState::offer(slam::GraphSolution solution) {
  slam::Mapper& mapper = impl_->mapper;
  if (!mapper.is_solving()) return;
  if (!solution.report.solved) {
    mapper.give_up_solving();
    return;
  }
  std::vector<types::Se2> poses = mapper.corrected(solution);
  impl_->correction = {std::move(solution), std::move(poses)};
}

void MappingState::join(std::span<const slam::KeyframePtr> keyframes,
                        std::span<const slam::FoundRelation> relations) {
  impl_->mates_keyframes.insert(impl_->mates_keyframes.end(), keyframes.begin(), keyframes.end());
  impl_->mates_relations.insert(impl_->mates_relations.end(), relations.begin(), relations.end());
}

void MappingState::relate(const slam::RelationKey& key, const slam::Relation& relation) {
  impl_->known.emplace_back(key, relation);
}

MappingOutput MappingState::finish() {
  MappingOutput output;
  impl_->run(output, true);
  for (const slam::LoopAnswer& answer : impl_->answers)
    output.loop_verdicts.push_back(impl_->mapper.apply(answer));
  impl_->answers.clear();
  if (impl_->mapper.keyframes().empty()) return output;
  if (impl_->has_news()) impl_->join_news(output);
  impl_->correction.reset();
  (void)impl_->mapper.optimise();
  impl_->builder.update(impl_->mapper.keyframes(), impl_->mapper.poses());
  ++impl_->revision;
  output.keyframe_added = true;
  return output;
}

std::unique_ptr<MapSnapshot> MappingState::make_snapshot() {
  const slam::Mapper& mapper = impl_->mapper;
  // Against what readers had before: the tiles that differ have been copied for them anyway.
  if (impl_->published)
    impl_->changed_cells += grid::differing_cells(*impl_->published, impl_->builder.grid());
  impl_->published = impl_->builder.grid();
  auto snapshot = std::make_unique<MapSnapshot>(
      MapSnapshot{impl_->revision,
                  impl_->changed_cells,
                  impl_->placed,
                  types::Transform2<types::Map, types::Odom>(mapper.T_map_odom()),
                  types::Transform2<types::Map, types::Base>(mapper.T_map_base()),
                  impl_->builder.grid(),
                  impl_->builder.walls(),
                  {}});
  const auto stations = [&](std::span<const std::size_t> way) {
    std::vector<types::KeyframePose> out;
    out.reserve(way.size());
    for (const std::size_t i : way)
      out.push_back(
          {mapper.keyframes()[i]->stamp, types::Transform2<types::Map, types::Base>(mapper.poses()[i])});
    return out;
  };
  snapshot->keyframes = stations(mapper.own_way());
  for (const auto& [origin, way] : mapper.mates_ways()) snapshot->mates.push_back(stations(way));
  return snapshot;
}

const slam::Mapper& MappingState::mapper() const { return impl_->mapper; }
std::uint64_t MappingState::revision() const { return impl_->revision; }
const slam::Cloud& MappingState::cloud() const { return impl_->cloud; }
const MappingLosses& MappingState::losses() const { return impl_->losses; }

MappingOutput mapping_step(MappingState& state, const MappingInput& input) {
  MappingOutput output;
  state.impl_->take(input);
  state.impl_->run(output, false);
  return output;
}

}  // namespace topo::pipeline

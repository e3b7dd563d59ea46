// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/loop_closure.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/slam/free_ground.hpp"
#include "core/slam/information.hpp"
#include "core/slam/refine.hpp"

namespace topo::slam {
namespace {

double reach_of(std::span<const Point> points, double reach_max_m) {
  float reach2 = 1.0F;
  for (const Point& p : points) reach2 = std::max(reach2, p.squaredNorm());
  return std::min(reach_max_m, static_cast<double>(std::sqrt(reach2)));
}

/// True when enough of the scan fits. A scan that sees much that the other visit did not can only fit in the
/// remaining part: a lower response is then sufficient if hardly any point contradicts the place.
bool fits(const Match& match, const LoopQuery& query, std::span<const Point> points, const LoopGroup& group,
          const SurfelMap& map) {
  const LoopGateParams& params = query.params.loop.gate;
  const bool wide = group.window.half_m > params.wide_m;
  if (match.response >= (wide ? params.response_min_wide : params.response_min)) return true;
  if (group.window.half_m < query.params.loop.match.search_from_m)
    return false;  // no drift to correct: the fit must be exact
  if (match.response < params.response_unopposed || match.fit() < params.fit_unopposed) return false;
  const double share_max = std::max(params.contradiction_max,
                                    (params.contradicting_points + 0.5) / static_cast<double>(points.size()));
  const FreeGround ground = seen_through(group.keyframes, group.poses, map, query.params.free_ground);
  return ground.contradiction(map, points, match.T_map_base) <= share_max;
}

LoopRejection gate(const Match& match, const LoopCandidate& candidate, const LoopQuery& query,
                   std::span<const Point> points, const LoopGroup& group, const SurfelMap& map) {
  const LoopGateParams& params = query.params.loop.gate;
  if (match.overlap < params.overlap_min) return LoopRejection::kLowOverlap;
  if (match.degenerate) return LoopRejection::kDegenerate;
  if (candidate.second_peak > params.peak_ratio_max) return LoopRejection::kAmbiguous;
  return fits(match, query, points, group, map) ? LoopRejection::kNone : LoopRejection::kLowResponse;
}

/// Start pose for the refinement: the best peak of the search in a wide window, the estimate in a narrow one.
std::optional<types::Se2> start_pose(const LoopQuery& query, std::span<const Point> points,
                                     const LoopGroup& group, const SurfelMap& map, LoopCandidate& candidate) {
  const LoopParams& params = query.params.loop;
  if (group.window.half_m < params.match.search_from_m) return query.pose;
  const LikelihoodPyramid pyramid(map, query.params.search);
  const auto best =
      search(pyramid, points, query.pose, group.window, params.match.score_min, query.params.search);
  if (!best) return std::nullopt;
  const auto second =
      search(pyramid, points, query.pose, group.window, params.gate.peak_ratio_max * best->score,
             query.params.search, Exclusion{best->T_map_base, params.match.apart_m, params.match.apart_rad});
  candidate.second_peak = second ? second->score / best->score : 0.0;
  return best->T_map_base;
}

/// `points`: the match points of the query's keyframe.
LoopCandidate match_group(const LoopQuery& query, std::span<const Point> points, const LoopGroup& group) {
  const MapperParams& params = query.params;
  LoopCandidate candidate;
  candidate.edge.from = group.reference;
  candidate.edge.to = query.node;
  candidate.edge.robust = true;
  SurfelMap map(params.refine.reach_m);
  const LoopMatchParams& limits = params.loop.match;
  map.reset(query.pose.translation().cast<float>(),
            reach_of(points, limits.reach_max_m) + group.window.half_m + limits.margin_m);
  for (std::size_t i = 0; i < group.keyframes.size(); ++i)
    map.add(group.keyframes[i]->content.surfels(), group.poses[i]);
  const auto start = start_pose(query, points, group, map, candidate);
  if (!start) return candidate;
  const Match match = refine(map, points, query.keyframe->sensor, *start, std::nullopt, params.refine);
  candidate.response = match.response;
  candidate.overlap = match.overlap;
  candidate.rejection = gate(match, candidate, query, points, group, map);
  candidate.edge.T_from_to = group.reference_pose.inverse() * match.T_map_base;
  candidate.edge.information =
      edge_information(match.scan_information, match.T_map_base.theta_rad, params.graph.loop_trans_floor_m,
                       params.graph.loop_rot_floor_rad);
  // Far outside the window: the refinement has diverged.
  const types::Se2 off = query.pose.inverse() * match.T_map_base;
  if (std::hypot(off.x_m, off.y_m) > limits.diverged_ratio * group.window.half_m + limits.diverged_m)
    candidate.rejection = LoopRejection::kNoMatch;
  return candidate;
}

}  // namespace

LoopAnswer find_closures(const LoopQuery& query) {
  LoopAnswer answer;
  answer.node = query.node;
  if (query.groups.empty()) return answer;
  const std::vector<Point> points = query.keyframe->content.match_points();
  for (const LoopGroup& group : query.groups) answer.candidates.push_back(match_group(query, points, group));
  return answer;
}

}  // namespace topo::slam

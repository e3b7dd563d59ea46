// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/own_past.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/slam/closure_span.hpp"
#include "core/slam/loop_candidates.hpp"
#include "core/slam/odometry_evidence.hpp"
#include "core/slam/pose_graph.hpp"

namespace topo::slam {
namespace {

/// Keyframes [first, last) of a path, without edges.
Session stretch(const MapGraph& graph, Way way, std::size_t first, std::size_t last) {
  Session session;
  for (const std::size_t node : way.subspan(first, last - first)) {
    session.keyframes.push_back(graph.keyframes()[node]);
    session.poses.push_back(graph.poses()[node]);
  }
  return session;
}

/// The uncertainty of an edge between neighbours on the path that no closure spans.
struct OpenStep {
  std::size_t place = 0;  ///< of its second keyframe
  types::Se2 pose;        ///< where it ends
  double square_m2 = 0.0, square_rad2 = 0.0;
};

/// A match that odometry contradicts may be as far off as odometry says.
std::vector<OpenStep> open_steps(const MapGraph& graph, Way way, const GraphParams& params) {
  std::vector<OpenStep> steps;
  for (const WayStep& step : way_steps(graph.edges(), graph.poses(), way, params.contradicted_chi2)) {
    if (step.spanned) continue;
    const Eigen::Matrix3d covariance = believed_covariance(*step.edge, graph.keyframes(), params.odometry);
    steps.push_back(
        {step.place, graph.poses()[step.edge->to], covariance(0, 0) + covariance(1, 1), covariance(2, 2)});
  }
  return steps;
}

/// Standard deviations of the path's pose before place `last` against the path before it.
struct Deviation {
  double m = 0.0, rad = 0.0;
};

Deviation deviation(std::span<const OpenStep> steps, std::size_t last, const types::Se2& pose) {
  double square_m2 = 0.0, square_rad2 = 0.0;
  for (const OpenStep& step : steps) {
    if (step.place >= last) continue;
    const double lever_m = distance_m(step.pose, pose);
    square_m2 += step.square_m2 + step.square_rad2 * lever_m * lever_m;
    square_rad2 += step.square_rad2;
  }
  return {std::sqrt(square_m2), std::sqrt(square_rad2)};
}

/// The stretch that ends before place `last` of the own path, where it may be further off than closures are
/// searched for.
std::optional<AlignmentQuery> search_for(std::size_t last, const MapGraph& graph,
                                         std::span<const OpenStep> steps, const OwnPastParams& past,
                                         const MapperParams& params) {
  const Way own = graph.own();
  if (last < past.past_min + past.window) return std::nullopt;
  const std::size_t first = last - past.window;
  const std::size_t end = end_of_other_visits(graph.poses(), own, first, params.loop);
  if (end < past.past_min) return std::nullopt;
  const Deviation off = deviation(steps, last, graph.poses()[own[last - 1]]);
  AlignmentGate gate;
  gate.off_max_m = past.sigmas * off.m;
  gate.off_max_rad = past.sigmas * off.rad;
  if (gate.off_max_m <= params.loop.search_max_m && gate.off_max_rad <= params.loop.search_max_rad)
    return std::nullopt;
  gate.agreeing_min = gate.clear_min = past.agreeing_min;
  gate.agreeing_share = 0.0;  // the stretch may have come back to known ground only in its end
  gate.rival_share = 0.0;
  return AlignmentQuery{stretch(graph, own, 0, end), stretch(graph, own, first, last), params, gate};
}

}  // namespace

std::optional<AlignmentQuery> OwnPast::take(const MapGraph& graph, const MapperParams& params) {
  const std::size_t size = graph.own().size();
  if (size < asked_at_ + params_.every) return std::nullopt;
  asked_at_ = looked_back_to_ = size;
  return search_for(size, graph, open_steps(graph, graph.own(), params.graph), params_, params);
}

/// The mapping thread looks at all stretches at once when none needs a search: the steps are found once.
std::optional<AlignmentQuery> OwnPast::take_idle(const MapGraph& graph, const MapperParams& params) {
  const bool is_new = graph.own().size() > asked_at_;
  if (!is_new && looked_back_to_ <= params_.every) return std::nullopt;
  const std::vector<OpenStep> steps = open_steps(graph, graph.own(), params.graph);
  if (is_new) {
    asked_at_ = looked_back_to_ = graph.own().size();
    if (auto query = search_for(asked_at_, graph, steps, params_, params)) return query;
  }
  while (looked_back_to_ > params_.every) {
    looked_back_to_ -= params_.every;
    if (auto query = search_for(looked_back_to_, graph, steps, params_, params)) return query;
  }
  return std::nullopt;
}

}  // namespace topo::slam

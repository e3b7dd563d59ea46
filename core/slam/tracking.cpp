// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/tracking.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/slam/information.hpp"
#include "core/slam/search.hpp"

namespace topo::slam {
namespace {

/// One search for a scan that does not fit where it is expected.
class ScanSearch {
 public:
  ScanSearch(const TrackingMap& map, const TrackedPoints& scan, const MapperParams& params)
      : map_(map), scan_(scan), params_(params), pyramid_(map.surfels, params.search) {}

  [[nodiscard]] Match near(const Prior& prior, const Prior& continued, Match match) const;
  /// True when the scan contradicts what was seen clearly less at the match than at the pose `instead_of`.
  [[nodiscard]] bool explains(const Match& match, const types::Se2& instead_of) const;
  [[nodiscard]] std::optional<Match> elsewhere(const types::Se2& predicted, const SearchWindow& window) const;

 private:
  const TrackingMap& map_;
  const TrackedPoints& scan_;
  const MapperParams& params_;
  LikelihoodPyramid pyramid_;
};

bool is_good(const Match& match, const TrackParams& params) {
  return match.fit() >= params.response_good && match.response >= params.response_lost;
}

SearchWindow window_around(const Prior& prior, const TrackParams& params) {
  const double sigma_m = 1.0 / std::sqrt(prior.information(0, 0));
  const double sigma_rad = 1.0 / std::sqrt(prior.information(2, 2));
  return {std::min(params.search_max_m, params.search_floor_m + params.search_sigmas * sigma_m),
          std::min(params.search_max_rad, params.search_floor_rad + params.search_sigmas * sigma_rad)};
}

bool is_likely(const types::Se2& pose, const Prior& prior, const TrackParams& params) {
  const types::Se2 off = prior.T_map_base.inverse() * pose;
  const Eigen::Vector3d e(off.x_m, off.y_m, off.theta_rad);
  return e.dot(prior.information * e) <= params.likely_sigmas * params.likely_sigmas;
}

bool is_within(const SearchWindow& window, const types::Se2& off) {
  return std::hypot(off.x_m, off.y_m) <= window.half_m && std::abs(off.theta_rad) <= window.half_rad;
}

/// The continued motion is tried beside the window: odometry that was held up for a second reports nothing
/// and then the whole motion at once, which scans have been matched for meanwhile.
Match ScanSearch::near(const Prior& prior, const Prior& continued, Match match) const {
  const SurfelMap& map = map_.surfels;
  const TrackParams& track = params_.track;
  const SearchWindow window = window_around(prior, track);
  if (const auto hit =
          search(pyramid_, scan_.points, prior.T_map_base, window, track.search_score_min, params_.search)) {
    const Match other = refine(map, scan_.points, scan_.sensor, hit->T_map_base, prior, params_.refine);
    if (other.response > match.response + track.search_better_by) match = other;
  }
  if (!is_within(window, prior.T_map_base.inverse() * continued.T_map_base)) {
    const Match other =
        refine(map, scan_.points, scan_.sensor, continued.T_map_base, continued, params_.refine);
    if (is_good(other, track) && other.response > match.response + track.search_better_by) match = other;
  }
  return match;
}

/// Wheels slip and robots are turned by hand, which odometry does not measure. Odometry is kept where two
/// places fit (a corridor in both directions), and where it leads to unknown ground: there nothing can fit,
/// and a fit elsewhere is chance.
std::optional<Match> ScanSearch::elsewhere(const types::Se2& predicted, const SearchWindow& window) const {
  const TurnedParams& turned = params_.track.turned;
  const auto hit = search(pyramid_, scan_.points, predicted, window, turned.score_min, params_.search);
  if (!hit) return std::nullopt;
  const Exclusion found{hit->T_map_base, turned.half_width_m, turned.apart_rad};
  if (search(pyramid_, scan_.points, predicted, window, turned.peak_ratio * hit->score, params_.search,
             found))
    return std::nullopt;
  const Match match =
      refine(map_.surfels, scan_.points, scan_.sensor, hit->T_map_base, std::nullopt, params_.refine);
  if (match.response < turned.response_min || match.degenerate || !explains(match, predicted))
    return std::nullopt;
  return match;
}

bool ScanSearch::explains(const Match& match, const types::Se2& instead_of) const {
  const TurnedParams& turned = params_.track.turned;
  const FreeGround ground = map_.ground();
  const double instead = ground.contradiction(map_.surfels, scan_.points, instead_of);
  return instead >= turned.contradiction_min &&
         turned.contradiction_ratio * ground.contradiction(map_.surfels, scan_.points, match.T_map_base) <=
             instead;
}

}  // namespace

Prior predict(const TrackedMotion& last, const types::Se2& T_odom_base, double seconds,
              const MotionNoise& noise) {
  const types::Se2 motion = last.T_odom_base.inverse() * T_odom_base;
  if (!is_drivable(motion, seconds, noise)) return continued(last, seconds, noise);
  return {last.T_map_base * motion, motion_information(motion, noise)};
}

Prior continued(const TrackedMotion& last, double seconds, const MotionNoise& noise) {
  const double times =
      last.previous_last_s > 0.0 ? std::clamp(seconds / last.previous_last_s, 0.0, 1.0) : 0.0;
  const types::Se2 motion = types::interpolate({}, last.T_previous_last, times);
  return {last.T_map_base * motion,
          motion_information(motion, noise) / (noise.continued_sigmas * noise.continued_sigmas)};
}

Tracked track(const TrackingMap& map, const TrackedPoints& scan, const TrackedMotion& last,
              const Prior& prior, const Prior& continued, const MapperParams& params) {
  const types::Se2& predicted = prior.T_map_base;
  const TrackParams& limits = params.track;
  Match match = refine(map.surfels, scan.points, scan.sensor, predicted, prior, params.refine);
  const SearchWindow near = window_around(prior, limits);
  const double astray_m = limits.search_ways * distance_m(last.T_map_base, predicted);
  const auto is_doubtful = [&] {
    return !is_good(match, limits) || (astray_m > near.half_m && match.response < limits.turned.response_min);
  };
  const auto kept = [&](const Match& m) { return m.response >= limits.response_lost; };
  // A covered scanner sees nothing in any scan: that fits nowhere, and a search is the dearest part of a
  // step.
  if (!is_doubtful() || scan.points.empty()) return {match, kept(match), false};
  const ScanSearch search(map, scan, params);
  std::optional<Match> explained;
  if (!is_good(match, limits)) {
    const Match found = search.near(prior, continued, match);
    if (found.response >= limits.turned.response_min || is_likely(found.T_map_base, prior, limits))
      match = found;
    else if (found.response >= limits.response_explained && search.explains(found, predicted))
      explained = found;
    if (explained && kept(*explained)) match = *explained;
  }
  if (astray_m > near.half_m && is_doubtful()) {
    const SearchWindow far{std::min(limits.search_max_m, near.half_m + astray_m), near.half_rad};
    if (const auto other = search.elsewhere(predicted, far)) return {*other, true, true};
  }
  if (kept(match)) return {match, true, true};
  const SearchWindow all_round{limits.turned.half_width_m, std::numbers::pi};
  if (const auto other = search.elsewhere(predicted, all_round)) return {*other, true, true};
  return {explained.value_or(match), explained.has_value(), true};
}

}  // namespace topo::slam

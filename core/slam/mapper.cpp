// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/mapper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/slam/information.hpp"
#include "core/slam/make_keyframe.hpp"
#include "core/slam/search.hpp"

namespace topo::slam {
namespace {

constexpr double kLocalHalfWidth_m = 32.0;  ///< beyond the scanner's range
constexpr double kRecentre_m = 6.0;         ///< maximum distance of the robot from the window's centre
constexpr double kTurnedScore = 0.35;       ///< minimum likelihood of a pose found elsewhere
constexpr double kTurnedApart_rad = 0.3;    ///< closer headings are one peak
constexpr double kSearchResponse = 0.05;    ///< minimum gain in response for a found pose to be preferred

constexpr double kUnheard = 9.0;  ///< the deviation of an extrapolated motion is three times as large

/// True when a robot can drive such a motion. Odometry that was reset (a base that was switched off and on)
/// reports a motion that is not drivable.
bool is_drivable(const types::Se2& motion, double seconds, const MotionNoise& noise) {
  const double way_m = std::hypot(motion.x_m, motion.y_m);
  return way_m <= noise.jump_min_m || way_m <= noise.speed_max_mps * seconds;
}

bool is_good(const Match& match, const TrackParams& params) {
  return match.fit() >= params.response_good && match.response >= params.response_lost;
}

SearchWindow window_around(const Prior& prior, const TrackParams& params) {
  const double sigma_m = 1.0 / std::sqrt(prior.information(0, 0));
  const double sigma_rad = 1.0 / std::sqrt(prior.information(2, 2));
  return {std::min(params.search_max_m, params.search_floor_m + params.search_sigmas * sigma_m),
          std::min(params.search_max_rad, params.search_floor_rad + params.search_sigmas * sigma_rad)};
}

bool is_within(const SearchWindow& window, const types::Se2& off) {
  return std::hypot(off.x_m, off.y_m) <= window.half_m && std::abs(off.theta_rad) <= window.half_rad;
}

}  // namespace

Mapper::Mapper(const MapperParams& params, const Origin& origin, const types::Se2& start)
    : params_(params),
      maker_(origin),
      start_(start),
      local_map_(params.refine.reach_m),
      open_questions_(0.5 * params.loop.search_floor_m, 0.5 * params.loop.search_floor_rad,
                      static_cast<std::size_t>(params.loop.group_half)) {}

MatchReport Mapper::add(const Cloud& cloud, const types::Se2& T_odom_base, walls::ColumnCollector& columns) {
  MatchReport report;
  report.stamp = cloud.stamp;
  select_points(cloud, params_.cloud, points_);
  if (keyframes_.empty()) {
    T_map_base_ = report.T_map_base = start_;
    T_odom_base_ = T_odom_base;
    stamp_ = cloud.stamp;
    report.matched = true;
    add_keyframe(cloud, report, {}, columns);
    report.keyframe = true;
    return report;
  }
  const types::Se2 motion = T_odom_base_.inverse() * T_odom_base;
  const double seconds = types::to_seconds(cloud.stamp - stamp_);
  const Prior prior = predict(motion, seconds);
  const types::Se2& predicted = prior.T_map_base;
  report.match = track(prior, going_on(seconds), cloud.sensor, report.searched);
  report.matched = report.match.response >= params_.track.response_lost && report.match.overlap > 0.0;
  const types::Se2 pose = report.matched ? report.match.T_map_base : predicted;
  T_previous_last_ = T_map_base_.inverse() * pose;
  previous_last_s_ = seconds;
  T_map_base_ = pose;
  T_odom_base_ = T_odom_base;
  stamp_ = cloud.stamp;
  report.T_map_base = T_map_base_;
  const bool due = is_apart(own_.back(), params_.keyframe.travel_m, params_.keyframe.turn_rad) ||
                   cloud.invalid_share < invalid_share_ - params_.keyframe.unveiled_share;
  if (due && has_enough_alike()) {
    columns.drop();
  } else if (due) {
    add_keyframe(cloud, report, prior, columns);
    report.keyframe = true;
  }
  report.node = own_.back();
  report.T_node_base = poses_[report.node].inverse() * T_map_base_;
  return report;
}

/// When odometry reports a motion that is not drivable, the previous motion is extrapolated.
Prior Mapper::predict(const types::Se2& motion, double seconds) const {
  if (!is_drivable(motion, seconds, params_.motion)) return going_on(seconds);
  return {T_map_base_ * motion, motion_information(motion, params_.motion)};
}

Prior Mapper::going_on(double seconds) const {
  const double times = previous_last_s_ > 0.0 ? std::clamp(seconds / previous_last_s_, 0.0, 1.0) : 0.0;
  const types::Se2 guess = types::interpolate({}, T_previous_last_, times);
  return {T_map_base_ * guess, motion_information(guess, params_.motion) / kUnheard};
}

/// When nothing fits near the odometry pose, the robot is searched for elsewhere. After a long motion this is
/// also done when the response is low: with wheels that slip, or do not distinguish forwards from backwards,
/// the error is up to twice the motion, and half of another room may fit there.
Match Mapper::track(const Prior& prior, const Prior& going_on, const Point& sensor, bool& searched) {
  const types::Se2& predicted = prior.T_map_base;
  const TrackParams& limits = params_.track;
  Match match = refine(local_map_, points_, sensor, predicted, prior, params_.refine);
  const SearchWindow near = window_around(prior, limits);
  const double astray_m = limits.search_ways * distance_m(T_map_base_, predicted);
  const auto is_doubtful = [&] {
    return !is_good(match, limits) || (astray_m > near.half_m && match.response < limits.turned_response);
  };
  if (!is_doubtful()) return match;
  searched = true;
  const LikelihoodPyramid pyramid(local_map_, params_.search);
  if (!is_good(match, limits)) match = search_near(pyramid, prior, going_on, sensor, match);
  if (astray_m > near.half_m && is_doubtful()) {
    const SearchWindow far{std::min(limits.search_max_m, near.half_m + astray_m), near.half_rad};
    if (const auto other = find_elsewhere(pyramid, predicted, far, sensor)) return *other;
  }
  if (match.response >= limits.response_lost) return match;
  const SearchWindow all_round{limits.turned_m, std::numbers::pi};
  return find_elsewhere(pyramid, predicted, all_round, sensor).value_or(match);
}

/// In addition to the window, the extrapolation of the previous motion is tried: odometry that was delayed
/// for a second reports no motion and then all of it at once, when that motion has already been matched.
Match Mapper::search_near(const LikelihoodPyramid& pyramid, const Prior& prior, const Prior& going_on,
                          const Point& sensor, Match match) const {
  const SearchWindow window = window_around(prior, params_.track);
  if (const auto hit = search(pyramid, points_, prior.T_map_base, window, 0.2, params_.search)) {
    const Match other = refine(local_map_, points_, sensor, hit->T_map_base, prior, params_.refine);
    if (other.response > match.response + kSearchResponse) match = other;
  }
  if (!is_within(window, prior.T_map_base.inverse() * going_on.T_map_base)) {
    const Match gone_on = refine(local_map_, points_, sensor, going_on.T_map_base, going_on, params_.refine);
    if (is_good(gone_on, params_.track) && gone_on.response > match.response + kSearchResponse)
      match = gone_on;
  }
  return match;
}

/// Odometry does not register slipping wheels or a robot that is turned by hand. The odometry pose is kept
/// where two places fit (the two directions of a corridor), and where it leads to unobserved ground: nothing
/// can fit there, and a fit elsewhere is accidental.
std::optional<Match> Mapper::find_elsewhere(const LikelihoodPyramid& pyramid, const types::Se2& predicted,
                                            const SearchWindow& window, const Point& sensor) const {
  const TrackParams& track = params_.track;
  const auto hit = search(pyramid, points_, predicted, window, kTurnedScore, params_.search);
  if (!hit) return std::nullopt;
  const Exclusion found{hit->T_map_base, track.turned_m, kTurnedApart_rad};
  if (search(pyramid, points_, predicted, window, track.turned_peak_ratio * hit->score, params_.search,
             found))
    return std::nullopt;
  const Match match = refine(local_map_, points_, sensor, hit->T_map_base, std::nullopt, params_.refine);
  if (match.response < track.turned_response || match.degenerate) return std::nullopt;
  const FreeGround ground = local_ground();
  const double as_heard = ground.contradiction(local_map_, points_, predicted);
  if (as_heard < track.turned_contradiction_min ||
      2.0 * ground.contradiction(local_map_, points_, match.T_map_base) > as_heard)
    return std::nullopt;
  return match;
}

/// Ground crossed by the rays of the local map's keyframes.
FreeGround Mapper::local_ground() const {
  std::vector<KeyframePtr> keyframes;
  std::vector<types::Se2> poses;
  for (std::size_t k = window_first_; k < own_.size(); ++k) {
    keyframes.push_back(keyframes_[own_[k]]);
    poses.push_back(poses_[own_[k]]);
  }
  return seen_through(keyframes, poses, local_map_);
}

/// True when the robot is further than this from where a keyframe was made, or turned by more.
bool Mapper::is_apart(std::size_t node, double way_m, double turn_rad) const {
  const types::Se2& pose = poses_[node];
  return distance_m(pose, T_map_base_) > way_m ||
         std::abs(types::wrap_angle(T_map_base_.theta_rad - pose.theta_rad)) > turn_rad;
}

/// True when the tracking window has enough keyframes near the robot's pose.
bool Mapper::has_enough_alike() const {
  const KeyframeParams& params = params_.keyframe;
  const auto alike =
      std::count_if(own_.begin() + static_cast<std::ptrdiff_t>(window_first_), own_.end(),
                    [&](std::size_t node) { return !is_apart(node, params.alike_m, params.alike_rad); });
  return alike >= params.alike_max;
}

void Mapper::add_keyframe(const Cloud& cloud, const MatchReport& report, const Prior& prior,
                          walls::ColumnCollector& columns) {
  auto keyframe = make_keyframe({maker_.robot, next_sequence_++, maker_.run}, cloud, points_, T_odom_base_,
                                columns.take(T_odom_base_.inverse()), params_.cloud);
  invalid_share_ = cloud.invalid_share;
  const bool first = own_.empty();
  const std::size_t before = first ? 0 : own_.back();
  const std::size_t node = add_own_node(std::move(keyframe), T_map_base_);
  if (!first) {
    Edge edge;
    edge.from = before;
    edge.to = node;
    edge.T_from_to = poses_[before].inverse() * T_map_base_;
    Eigen::Matrix3d information = report.matched ? report.match.scan_information : Eigen::Matrix3d::Zero();
    information +=
        report.matched
            ? prior.information
            : motion_information(keyframes_[before]->T_odom_base.inverse() * T_odom_base_, params_.motion);
    edge.information =
        edge_information(information, T_map_base_.theta_rad, params_.graph.odometry_trans_floor_m,
                         params_.graph.odometry_rot_floor_rad);
    add_found_edge(edge);
  }
  extend_local_map();
  ask(node);
}

std::size_t Mapper::add_node(KeyframePtr keyframe, const types::Se2& pose) {
  const std::size_t node = keyframes_.size();
  nodes_[keyframe->id] = node;
  keyframes_.push_back(std::move(keyframe));
  poses_.push_back(pose);
  return node;
}

std::size_t Mapper::add_own_node(KeyframePtr keyframe, const types::Se2& pose) {
  own_.push_back(add_node(std::move(keyframe), pose));
  return own_.back();
}

void Mapper::extend_local_map() {
  const Point here = T_map_base_.translation().cast<float>();
  const std::size_t held = own_.size() - window_first_;
  const bool first = own_.size() == 1;
  // Removing a keyframe requires a rebuild of the map: a few are collected first.
  if (first || (here - local_centre_).norm() > static_cast<float>(kRecentre_m) ||
      held > static_cast<std::size_t>(2 * params_.keyframe.window_travel_m / params_.keyframe.travel_m)) {
    rebuild_local_map();
  } else {
    local_map_.add(keyframes_[own_.back()]->surfels, poses_[own_.back()]);
  }
}

void Mapper::rebuild_local_map() {
  local_centre_ = T_map_base_.translation().cast<float>();
  local_map_.reset(local_centre_, kLocalHalfWidth_m);
  double travelled = 0.0;
  window_first_ = own_.size() - 1;
  while (window_first_ > 0 &&
         (travelled < params_.keyframe.window_travel_m ||
          own_.size() - window_first_ < static_cast<std::size_t>(params_.keyframe.window_min))) {
    travelled += distance_m(poses_[own_[window_first_]], poses_[own_[window_first_ - 1]]);
    --window_first_;
  }
  for (std::size_t k = window_first_; k < own_.size(); ++k)
    local_map_.add(keyframes_[own_[k]]->surfels, poses_[own_[k]]);
  // A resumed path is short at first: older keyframes of the same place support it until the window has left
  // that place.
  if (window_first_ > resumed_at_) neighbours_.clear();
  for (const std::size_t i : neighbours_) {
    if (i < own_[window_first_]) local_map_.add(keyframes_[i]->surfels, poses_[i]);
  }
}

}  // namespace topo::slam

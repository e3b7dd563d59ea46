// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/moving_obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "core/perception/look_match.hpp"
#include "core/types/robot_limits.hpp"

namespace topo::perception {

using types::Se2;
using types::Vector2;

Se2 pose_at(const types::Odometry& odometry, types::Stamp when) {
  // A bound for stamps that are wrong: past the default of this age the gate stops the robot.
  constexpr double kMost_s = types::to_seconds(types::RobotLimits{}.status_age_max);
  const double dt_s = std::clamp(types::to_seconds(when - odometry.stamp), -kMost_s, kMost_s);
  const double turn = odometry.twist.omega_radps * dt_s, way = odometry.twist.v_mps * dt_s;
  return odometry.T_odom_base.se2() * Se2{way * std::cos(0.5 * turn), way * std::sin(0.5 * turn), turn};
}

/// Straight line through the newest sightings of the anchor with the longest uninterrupted visibility.
struct MovingObstacles::Fit {
  explicit Fit(const Track& track) {
    for (const std::size_t candidate : {kCentre, kBegin, kEnd}) {
      std::size_t begin = track.sightings;
      while (begin > 0 && track.seen[begin - 1].known[candidate]) --begin;
      if (track.sightings - begin <= sightings) continue;
      sightings = track.sightings - begin;
      anchor = candidate;
    }
    if (sightings > 1) lay(track);
  }
  std::size_t anchor = kCentre;
  std::size_t sightings = 0;
  Vector2 velocity_mps{0.0, 0.0};
  double off_m = 0.0;  ///< distance of the farthest sighting from the line
  double span_s = 0.0;

 private:
  void lay(const Track& track) {
    const std::size_t begin = track.sightings - sightings;
    const auto n = static_cast<double>(sightings);
    double mean_s = 0.0, square_s2 = 0.0;
    Vector2 mean(0.0, 0.0), product(0.0, 0.0);
    for (std::size_t i = begin; i < track.sightings; ++i) {
      mean_s += track.seen[i].at_s / n;
      mean += track.seen[i].p[anchor] / n;
    }
    for (std::size_t i = begin; i < track.sightings; ++i) {
      const double off_s = track.seen[i].at_s - mean_s;
      square_s2 += off_s * off_s;
      product += off_s * (track.seen[i].p[anchor] - mean);
    }
    if (!(square_s2 > 0.0)) return;
    velocity_mps = product / square_s2;
    for (std::size_t i = begin; i < track.sightings; ++i) {
      const Vector2 on = mean + (track.seen[i].at_s - mean_s) * velocity_mps;
      off_m = std::max(off_m, (track.seen[i].p[anchor] - on).norm());
    }
    span_s = track.newest().at_s - track.seen[begin].at_s;
  }
};

Vector2 MovingObstacles::Track::expected(double at_s) const {
  const Sighting& last = newest();
  return moving ? Vector2(last.p[kCentre] + (at_s - last.at_s) * velocity_mps) : last.p[kCentre];
}

void MovingObstacles::forget() {
  count_ = tracked_ = 0;
  trusted_ = false;
}

bool MovingObstacles::continues(const ScanLook& next, const Se2& T_odom_laser) const {
  if (count_ == 0 || next.stamp - look(0).stamp > params_.sweeps.pause) return false;
  return (T_odom_laser_.inverse() * T_odom_laser).translation().norm() < params_.sweeps.carried_m;
}

void MovingObstacles::begin(const Se2& T_odom_laser) {
  forget();
  origin_ = look(0).stamp;
  poses_[newest_] = T_odom_laser;
}

/// Pose of the scanner at the newest sweep: predicted from odometry, corrected by a match with static
/// surroundings.
void MovingObstacles::reckon(const Se2& T_odom_laser) {
  const LookMatch match =
      match_looks(look(1), look(0), T_odom_laser_.inverse() * T_odom_laser, params_.match);
  trusted_ = match.explained >= params_.sweeps.explained_min;
  poses_[newest_] = pose(1) * match.T_before_now;
}

void MovingObstacles::update(const types::Scan& scan, const Se2& T_base_laser,
                             const types::Odometry& odometry) {
  const types::Duration every = params_.sweeps.every;
  if (count_ > 0 && scan.first_beam - look(0).stamp < every && scan.first_beam > look(0).stamp - every)
    return;
  const std::size_t next = (newest_ + 1) % kLooks;
  if (!take_look(scan, odometry.twist.omega_radps, looks_[next])) return forget();
  const Se2 T_odom_laser = pose_at(odometry, looks_[next].stamp) * T_base_laser;
  const bool goes_on = continues(looks_[next], T_odom_laser);
  newest_ = next;
  if (goes_on)
    reckon(T_odom_laser);
  else
    begin(T_odom_laser);
  T_odom_laser_ = T_odom_laser;
  T_base_laser_ = T_base_laser;
  count_ = std::min(count_ + 1, kLooks);
  if (trusted_)
    follow_groups();
  else
    doubt();
}

/// The scanner's pose is unknown: positions before and after are not comparable.
void MovingObstacles::doubt() {
  const auto end = tracks_.begin() + static_cast<std::ptrdiff_t>(tracked_);
  const auto gone = [&](const Track& t) {
    return !t.moving || now_s() - t.newest().at_s > params_.tracks.gone_s;
  };
  tracked_ = static_cast<std::size_t>(std::remove_if(tracks_.begin(), end, gone) - tracks_.begin());
}

void MovingObstacles::follow_groups() {
  const TrackParams& p = params_.tracks;
  std::array<ScanGroup, kGroups> groups;
  const std::size_t found = find_groups(look(0), params_.groups, groups);
  std::array<bool, kGroups> taken{};
  const std::size_t known = tracked_;
  for (std::size_t t = 0; t < known; ++t) {
    Track& track = tracks_[t];
    const double since_s = now_s() - track.newest().at_s;
    const double reach_m = p.search_m + (track.moving ? p.surprise * p.fastest_mps : p.fastest_mps) * since_s;
    std::size_t best = found;
    double best_m = reach_m;
    for (std::size_t g = 0; g < found; ++g) {
      const double off_m = (pose(0) * groups[g].centre - track.expected(now_s())).norm();
      if (taken[g] || !(off_m < best_m)) continue;
      best = g;
      best_m = off_m;
    }
    if (best == found) continue;
    taken[best] = true;
    follow(track, groups[best]);
  }
  for (std::size_t g = 0; g < found; ++g)
    if (!taken[g]) begin_track(groups[g]);
  const auto gone = [&](const Track& track) {
    return now_s() - track.newest().at_s > (track.has_moved ? p.gone_s : p.gone_still_s);
  };
  const auto end = tracks_.begin() + static_cast<std::ptrdiff_t>(tracked_);
  tracked_ = static_cast<std::size_t>(std::remove_if(tracks_.begin(), end, gone) - tracks_.begin());
}

MovingObstacles::Sighting MovingObstacles::sighting_of(const ScanGroup& group) const {
  return {now_s(),
          {pose(0) * group.centre, pose(0) * group.begin, pose(0) * group.end},
          {group.begins_freely && group.ends_freely, group.begins_freely, group.ends_freely}};
}

void MovingObstacles::begin_track(const ScanGroup& group) {
  if (tracked_ == kTracks) return;
  Track& track = tracks_[tracked_++];
  track = Track{};
  track.seen[0] = sighting_of(group);
  track.sightings = 1;
  track.radius_m = group.radius_m;
}

void MovingObstacles::follow(Track& track, const ScanGroup& group) {
  std::size_t begin = track.sightings == kLooks ? 1 : 0;
  while (begin < track.sightings && now_s() - track.seen[begin].at_s > params_.tracks.window_s) ++begin;
  std::copy(track.seen.begin() + static_cast<std::ptrdiff_t>(begin),
            track.seen.begin() + static_cast<std::ptrdiff_t>(track.sightings), track.seen.begin());
  track.sightings -= begin;
  track.seen[track.sightings++] = sighting_of(group);
  track.radius_m = group.radius_m;
  judge(track, group);
}

void MovingObstacles::judge(Track& track, const ScanGroup& group) {
  const TrackParams& p = params_.tracks;
  const Fit fit(track);
  if (fit.sightings < p.sightings_min) return;
  if (!track.moving && begins_to_move(track, fit, group)) {
    track.moving = track.has_moved = true;
    track.slow_since_s = now_s();
  }
  if (!track.moving) return;
  track.velocity_mps = fit.velocity_mps;
  if (fit.velocity_mps.norm() > p.still_mps) track.slow_since_s = now_s();
  track.moving = now_s() - track.slow_since_s < p.still_s;
}

bool MovingObstacles::begins_to_move(const Track& track, const Fit& fit, const ScanGroup& group) const {
  const double speed_mps = fit.velocity_mps.norm(), covered_m = speed_mps * fit.span_s;
  const BeginsToMoveParams& p = params_.begins;
  const double noise_m = (p.noise_share + p.noise_beams * look(0).step_rad) * group.centre.norm();
  if (fit.off_m > p.off_noise_share * noise_m + p.off_m + p.off_covered_share * covered_m) return false;
  if (track.has_moved) return speed_mps > p.again_mps && covered_m > p.covered_again_m + noise_m;
  return speed_mps > p.speed_mps && covered_m > p.covered_m + noise_m && was_clear(group);
}

/// True when the scanner recently saw through a part of the group's location.
bool MovingObstacles::was_clear(const ScanGroup& group) const {
  const BeginsToMoveParams& params = params_.begins;
  std::size_t age = 1;
  while (age + 1 < count_ && types::to_seconds(look(0).stamp - look(age).stamp) < params.before_s) ++age;
  if (age >= count_) return false;
  const ScanLook& before = look(age);
  const Se2 T_before_now = pose(age).inverse() * pose(0);
  std::size_t points = 0, clear = 0;
  for_each_point(look(0), group, [&](const Vector2& p_now) {
    const Vector2 p = T_before_now * p_now;
    ++points;
    if (before.clear_towards_m(p, params.beside_m) > p.norm() + params.through_m) ++clear;
  });
  return static_cast<double>(clear) >=
         std::max(params.clear_min, params.clear_share * static_cast<double>(points));
}

std::size_t MovingObstacles::around(const types::Odometry& odometry, types::Stamp when,
                                    std::span<MovingObstacle, kMax> out) const {
  if (count_ == 0) return 0;
  // In the frame of the sweeps, the base is at its pose of the newest sweep, moved on since by odometry.
  const Se2 T_then_when = (T_odom_laser_ * T_base_laser_.inverse()).inverse() * pose_at(odometry, when);
  const Se2 T_base_local = (pose(0) * T_base_laser_.inverse() * T_then_when).inverse();
  const double when_s = types::to_seconds(when - origin_);
  const auto nearer = [](const MovingObstacle& a, const MovingObstacle& b) {
    return a.centre.squaredNorm() < b.centre.squaredNorm();
  };
  std::size_t count = 0;
  for (std::size_t t = 0; t < tracked_; ++t) {
    const Track& track = tracks_[t];
    if (!track.moving) continue;
    const MovingObstacle one{T_base_local * track.expected(when_s),
                             Vector2(Se2{0.0, 0.0, T_base_local.theta_rad} * track.velocity_mps),
                             track.radius_m};
    if (count == kMax && !nearer(one, out[kMax - 1])) continue;
    out[std::min(count, kMax - 1)] = one;
    count = std::min(count + 1, kMax);
    std::sort(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count), nearer);
  }
  return count;
}

}  // namespace topo::perception

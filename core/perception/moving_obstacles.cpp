// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/moving_obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "core/perception/look_match.hpp"

namespace topo::perception {
namespace {

using types::Se2;
using types::Vector2;

constexpr types::Duration kEvery = std::chrono::milliseconds(90);
constexpr types::Duration kPause = std::chrono::milliseconds(450);
constexpr double kCarried_m = 0.5;   // between sweeps: more than any wheel can drive
constexpr double kExplained = 0.85;  // least fraction of beams that fit; below, the scanner's pose is unknown
constexpr double kMoves_mps = 0.2, kMovesAgain_mps = 0.1, kStill_mps = 0.1;
constexpr double kStill_s = 0.4;  // slow for this long: it stands
constexpr double kGone_s = 0.5;   // unseen for this long: it is gone
constexpr double kGoneStill_s = 0.25;
constexpr double kCovered_m = 0.06, kCoveredAgain_m = 0.02;  // on top of noise: what a change of view shifts
constexpr double kFastest_mps = 2.0;
constexpr double kWindow_s = 0.55;
constexpr double kBefore_s = 0.25;  // least age of the sweep that may have seen the location free

}  // namespace

Se2 pose_at(const types::Odometry& odometry, types::Stamp when) {
  constexpr double kMost_s = 0.3;
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
  if (count_ == 0 || next.stamp - look(0).stamp > kPause) return false;
  return (T_odom_laser_.inverse() * T_odom_laser).translation().norm() < kCarried_m;
}

void MovingObstacles::begin(const Se2& T_odom_laser) {
  forget();
  origin_ = look(0).stamp;
  poses_[newest_] = T_odom_laser;
}

/// Pose of the scanner at the newest sweep: predicted from odometry, corrected by a match with static
/// surroundings.
void MovingObstacles::reckon(const Se2& T_odom_laser) {
  const LookMatch match = match_looks(look(1), look(0), T_odom_laser_.inverse() * T_odom_laser);
  trusted_ = match.explained >= kExplained;
  poses_[newest_] = pose(1) * match.T_before_now;
}

void MovingObstacles::update(const types::Scan& scan, const Se2& T_base_laser,
                             const types::Odometry& odometry) {
  if (count_ > 0 && scan.first_beam - look(0).stamp < kEvery && scan.first_beam > look(0).stamp - kEvery)
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
  const auto gone = [&](const Track& t) { return !t.moving || now_s() - t.newest().at_s > kGone_s; };
  tracked_ = static_cast<std::size_t>(std::remove_if(tracks_.begin(), end, gone) - tracks_.begin());
}

void MovingObstacles::follow_groups() {
  std::array<ScanGroup, kGroups> groups;
  const std::size_t found = find_groups(look(0), groups);
  std::array<bool, kGroups> taken{};
  const std::size_t known = tracked_;
  for (std::size_t t = 0; t < known; ++t) {
    Track& track = tracks_[t];
    const double since_s = now_s() - track.newest().at_s;
    const double reach_m = 0.15 + (track.moving ? 0.5 * kFastest_mps : kFastest_mps) * since_s;
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
    return now_s() - track.newest().at_s > (track.has_moved ? kGone_s : kGoneStill_s);
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
  while (begin < track.sightings && now_s() - track.seen[begin].at_s > kWindow_s) ++begin;
  std::copy(track.seen.begin() + static_cast<std::ptrdiff_t>(begin),
            track.seen.begin() + static_cast<std::ptrdiff_t>(track.sightings), track.seen.begin());
  track.sightings -= begin;
  track.seen[track.sightings++] = sighting_of(group);
  track.radius_m = group.radius_m;
  judge(track, group);
}

void MovingObstacles::judge(Track& track, const ScanGroup& group) {
  constexpr std::size_t kLeast = 3;
  const Fit fit(track);
  if (fit.sightings < kLeast) return;
  if (!track.moving && begins_to_move(track, fit, group)) {
    track.moving = track.has_moved = true;
    track.slow_since_s = now_s();
  }
  if (!track.moving) return;
  track.velocity_mps = fit.velocity_mps;
  if (fit.velocity_mps.norm() > kStill_mps) track.slow_since_s = now_s();
  track.moving = now_s() - track.slow_since_s < kStill_s;
}

bool MovingObstacles::begins_to_move(const Track& track, const Fit& fit, const ScanGroup& group) const {
  const double speed_mps = fit.velocity_mps.norm(), covered_m = speed_mps * fit.span_s;
  const double noise_m = (0.01 + 1.5 * look(0).step_rad) * group.centre.norm();
  if (fit.off_m > 0.5 * noise_m + 0.03 + 0.15 * covered_m) return false;
  if (track.has_moved) return speed_mps > kMovesAgain_mps && covered_m > kCoveredAgain_m + noise_m;
  return speed_mps > kMoves_mps && covered_m > kCovered_m + noise_m && was_clear(group);
}

/// True when the scanner recently saw through a part of the group's location.
bool MovingObstacles::was_clear(const ScanGroup& group) const {
  constexpr double kThrough_m = 0.1, kBeside_m = 0.03, kPart = 0.25;
  std::size_t age = 1;
  while (age + 1 < count_ && types::to_seconds(look(0).stamp - look(age).stamp) < kBefore_s) ++age;
  if (age >= count_) return false;
  const ScanLook& before = look(age);
  const Se2 T_before_now = pose(age).inverse() * pose(0);
  std::size_t points = 0, clear = 0;
  for_each_point(look(0), group, [&](const Vector2& p_now) {
    const Vector2 p = T_before_now * p_now;
    ++points;
    if (before.clear_towards_m(p, kBeside_m) > p.norm() + kThrough_m) ++clear;
  });
  return static_cast<double>(clear) >= std::max(2.0, kPart * static_cast<double>(points));
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

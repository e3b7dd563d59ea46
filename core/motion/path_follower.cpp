// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/path_follower.hpp"

#include <algorithm>
#include <cmath>

#include "core/perception/footprint_sweep.hpp"
#include "core/types/braking.hpp"

namespace topo::motion {
namespace {

using types::Se2;
using types::Twist2;
using types::Vector2;

Se2 along(double curvature, double way_m) {
  const double half = 0.5 * curvature * way_m;
  const double chord = std::abs(half) < 1e-6 ? way_m : way_m * std::sin(half) / half;
  return {chord * std::cos(half), chord * std::sin(half), 2.0 * half};
}

/// Speed from which the robot can stop within `free_m`: v blind + v^2 / 2a = free.
double stoppable_mps(double free_m, double blind_s, double deceleration) {
  if (!(free_m > 0.0)) return 0.0;
  const double b = blind_s * deceleration;
  return 2.0 * free_m * deceleration / (b + std::sqrt(b * b + 2.0 * deceleration * free_m));
}

/// Distance in `time_s` when accelerating from `v0` to `v1`; at `v1` throughout when that is lower.
double way_m(double v0, double v1, double acceleration, double time_s) {
  if (v0 >= v1) return v1 * time_s;
  const double ramp_s = std::min(time_s, (v1 - v0) / acceleration);
  return v0 * ramp_s + 0.5 * acceleration * ramp_s * ramp_s + v1 * (time_s - ramp_s);
}

/// Angle by which the robot can turn on the spot where it will have come to a stop: it rolls on into a turn
/// that begins at speed. A turn that begins keeps some more than the gate does, or the noise of a range lets
/// it past a corner and not back.
double free_turn_rad(double sign, const FollowInput& in, const FollowerTurnParams& params) {
  const types::RobotLimits& l = *in.limits;
  const bool begins = std::abs(in.twist.omega_radps) < params.begun_radps;
  const double margin_m = l.turn_margin_m + (begins ? params.extra_margin_m : 0.0);
  const Vector2 roll{types::braking_m(in.twist.v_mps, l.deceleration_mps2), 0.0};
  const Twist2 spin{0.0, sign};
  perception::FirstContact first(spin, types::reach_m(types::grown(l.footprint, margin_m)));
  for (const Vector2& p : in.obstacles_base) {
    const Vector2 then = p - roll;
    // A point between the two margins may be free of the wider one alone, where the turn leads along it.
    const auto contact_s = [&](double kept_m) {
      return perception::contact_time_with_margin_s(then, spin, l.footprint, kept_m, in.contact);
    };
    first.offer(then, [&] { return std::min(contact_s(l.turn_margin_m), contact_s(margin_m)); });
  }
  return first.seconds();
}

}  // namespace

void PathFollower::reset() {
  has_path_ = turning_ = false;
  last_curvature_ = 0.0;
}

void PathFollower::take_path(const FollowInput& in) {
  const bool fresh = !has_path_ || in.path_number != path_number_;
  if (fresh) {
    points_ = std::min(in.path_odom.size(), kMaxPoints);
    std::copy_n(in.path_odom.begin(), points_, path_.begin());
    for (std::size_t i = 1; i < points_; ++i) s_m_[i] = s_m_[i - 1] + (path_[i] - path_[i - 1]).norm();
    path_number_ = in.path_number;
    has_path_ = true;
  }
  const double from_m = fresh ? 0.0 : here_.s_m - rules_.behind_m;
  here_ = station(in.T_odom_base.translation(), from_m, from_m + rules_.ahead_m);
}

PathFollower::Station PathFollower::station(const Vector2& p, double from_m, double to_m) const {
  Station best{0.0, HUGE_VAL, 0.0};
  if (points_ == 1) best = {0.0, (p - path_[0]).norm(), 0.0};
  for (std::size_t i = 0; i + 1 < points_; ++i) {
    if (s_m_[i + 1] < from_m || (s_m_[i] > to_m && best.distance_m < HUGE_VAL)) continue;
    const Vector2 way = path_[i + 1] - path_[i];
    const double length2 = way.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((p - path_[i]).dot(way) / length2, 0.0, 1.0) : 0.0;
    const double distance_m = (path_[i] + t * way - p).norm();
    if (distance_m < best.distance_m) best = {s_m_[i] + t * std::sqrt(length2), distance_m, 0.0};
  }
  const Vector2 on = point_at(best.s_m + rules_.tangent_m) - point_at(best.s_m - rules_.tangent_m);
  best.heading_rad = std::atan2(on.y(), on.x());
  return best;
}

Vector2 PathFollower::point_at(double s_m) const {
  if (s_m <= 0.0 || points_ == 1) return path_[0];
  const auto end = s_m_.begin() + static_cast<std::ptrdiff_t>(points_);
  const auto after = std::upper_bound(s_m_.begin(), end, s_m);
  if (after == end) return path_[points_ - 1];
  const auto i = static_cast<std::size_t>(after - s_m_.begin());
  const double length = s_m_[i] - s_m_[i - 1];
  return path_[i - 1] + (s_m - s_m_[i - 1]) / length * (path_[i] - path_[i - 1]);
}

double PathFollower::speed_on(double curvature, double margin_m, const FollowInput& in) const {
  const types::RobotLimits& l = *in.limits;
  double v_mps = l.v_max_mps;
  if (curvature != 0.0)
    v_mps = std::min(v_mps, std::min(rules_.omega_max_radps, l.omega_max_radps) / std::abs(curvature));
  const double blind_s = rules_.blind_slack * in.blind_s;
  const double enough_m = v_mps * blind_s + types::braking_m(v_mps, l.deceleration_mps2);
  const Twist2 arc{1.0, curvature};  // at 1 m/s, seconds are metres
  perception::FirstContact first(arc, types::reach_m(types::grown(l.footprint, margin_m)), enough_m);
  for (const Vector2& p : in.obstacles_base)
    first.offer(
        p, [&] { return perception::contact_time_with_margin_s(p, arc, l.footprint, margin_m, in.contact); });
  return std::min(v_mps, stoppable_mps(first.seconds(), blind_s, l.deceleration_mps2));
}

/// Speed that the gate allows in view of wheel slip, on arcs with the last curvature.
double PathFollower::slip_speed_mps(const FollowInput& in) const {
  const types::RobotLimits& l = *in.limits;
  double free_m = perception::kNever_s;
  for (const double slip : {l.slip_curvature_per_m, -l.slip_curvature_per_m}) {
    const Twist2 arc{1.0, last_curvature_ + slip};
    perception::FirstContact first(arc, types::reach_m(l.footprint), free_m);
    for (const Vector2& p : in.obstacles_base)
      first.offer(p, [&] { return perception::contact_time_s(p, arc, l.footprint); });
    free_m = first.seconds();
  }
  if (!std::isfinite(free_m)) return l.v_max_mps;
  return std::max(l.v_beside_mps,
                  stoppable_mps(free_m, rules_.blind_slack * in.alive_s, l.deceleration_mps2));
}

PathFollower::Arc PathFollower::rated(double curvature, double margin_m, double v_cap_mps,
                                      const FollowInput& in) const {
  const ArcScoreParams& p = rules_.score;
  Arc arc{curvature, std::min(v_cap_mps, speed_on(curvature, margin_m, in)), -1e9};
  if (arc.v_mps < rules_.crawl_mps) return arc;
  const double v0 = std::max(0.0, in.twist.v_mps);
  const double way =
      std::max(p.way_min_m, way_m(v0, arc.v_mps, in.limits->acceleration_mps2, rules_.horizon_s));
  const auto there = [&](double part) { return in.T_odom_base * along(curvature, part * way); };
  const double to_m = here_.s_m + way + p.beyond_m;
  const Se2 middle = there(0.5), end = there(1.0);
  const Station at_middle = station(middle.translation(), here_.s_m - rules_.behind_m, to_m);
  const Station at_end = station(end.translation(), here_.s_m - rules_.behind_m, to_m);
  const double off_rad = std::abs(types::wrap_angle(end.theta_rad - at_end.heading_rad));
  arc.score = (at_end.s_m - here_.s_m) + p.speed_s * arc.v_mps - p.end_off * at_end.distance_m -
              p.middle_off * at_middle.distance_m - p.heading_m_per_rad * off_rad -
              p.change_m2 * std::abs(curvature - last_curvature_);
  return arc;
}

PathFollower::Arc PathFollower::best_with_margin(double margin_m, double v_cap_mps,
                                                 const FollowInput& in) const {
  const Vector2 ahead = in.T_odom_base.inverse() * point_at(here_.s_m + rules_.lookahead_m);
  const double most = rules_.score.pursuit_max_per_m;
  const double pursuit = std::clamp(2.0 * ahead.y() / std::max(0.01, ahead.squaredNorm()), -most, most);
  Arc best = rated(pursuit, margin_m, v_cap_mps, in);
  for (const double curvature : rules_.score.curvatures_per_m) {
    const Arc arc = rated(curvature, margin_m, v_cap_mps, in);
    if (arc.score > best.score) best = arc;
  }
  return best;
}

/// Best arc with the extra margin, or without it when clearance is too small for a good speed.
PathFollower::Arc PathFollower::best_arc(double v_cap_mps, const FollowInput& in) const {
  const double margin_m = in.limits->margin_m;
  const Arc roomy = best_with_margin(margin_m + rules_.extra_margin_m, v_cap_mps, in);
  return roomy.v_mps < rules_.slow_mps && roomy.v_mps < v_cap_mps ? best_with_margin(margin_m, v_cap_mps, in)
                                                                  : roomy;
}

/// Angle to turn before driving on, when that scores better than driving on at the current heading; 0
/// otherwise. In a doorway the robot's heading must pass the jamb before it follows the path.
double PathFollower::better_turn_rad(const Arc& now, double turn_rad, double v_cap_mps,
                                     const FollowInput& in) const {
  const FollowerTurnParams& params = rules_.turn;
  std::array<Vector2, kMaxObstacles> near, turned;
  std::size_t count = 0;
  for (const Vector2& p : in.obstacles_base)
    if (p.squaredNorm() < params.slow_end_m * params.slow_end_m && count < near.size()) near[count++] = p;
  const double left_rad = free_turn_rad(1.0, in, params), right_rad = free_turn_rad(-1.0, in, params);
  double best_rad = 0.0, best_score = now.score;
  const auto offer = [&](double by_rad) {
    if (!(std::abs(by_rad) < (by_rad > 0.0 ? left_rad : right_rad))) return;
    if (!(std::abs(turn_rad - by_rad) < params.begin_rad)) return;
    const Se2 turn{0.0, 0.0, by_rad};
    std::transform(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), turned.begin(),
                   [&](const Vector2& p) { return turn.inverse() * p; });
    FollowInput after = in;
    after.T_odom_base = in.T_odom_base * turn;
    after.obstacles_base = {turned.data(), count};
    after.twist = {};
    const double score =
        best_arc(v_cap_mps, after).score - params.stop_cost_m - params.cost_m_per_rad * std::abs(by_rad);
    if (!(score > best_score)) return;
    best_score = score;
    best_rad = by_rad;
  };
  if (std::abs(turn_rad) > params.end_rad) offer(turn_rad);
  for (const double by_rad : params.tried_rad) offer(by_rad);
  return best_rad;
}

FollowOutput PathFollower::turn(double turn_rad, const FollowInput& in) const {
  const types::RobotLimits& l = *in.limits;
  double sign = turn_rad < 0.0 ? -1.0 : 1.0;
  double way_rad = std::abs(turn_rad);
  FollowOutput out;
  out.turn_rad = turn_rad;
  if (free_turn_rad(sign, in, rules_.turn) < way_rad) {
    constexpr double kTurn = 6.283185307179586;
    if (free_turn_rad(-sign, in, rules_.turn) < kTurn - way_rad) {
      out.blocked = true;
      return out;
    }
    sign = -sign;
    way_rad = kTurn - way_rad;
  }
  const double rate = std::sqrt(rules_.turn.braking * l.angular_acceleration_radps2 * way_rad);
  out.twist.omega_radps = sign * std::min(rate, l.omega_max_radps);
  return out;
}

FollowOutput PathFollower::drive(double turn_rad, double rest_m, const FollowInput& in) {
  const types::RobotLimits& l = *in.limits;
  const ArrivalParams& p = rules_.arrival;
  const double v_end_mps = in.ends_at_goal
                               ? std::max(p.slowest_mps, std::sqrt(p.braking * l.deceleration_mps2 * rest_m))
                               : l.v_max_mps;
  const double v_cap_mps = std::min(v_end_mps, slip_speed_mps(in));
  const Arc best = best_arc(v_cap_mps, in);
  FollowOutput out;
  out.turn_rad = turn_rad;
  if (best.v_mps < std::min(rules_.slow_mps, v_cap_mps) - rules_.turn.slower_mps) {
    const double by_rad = better_turn_rad(best, turn_rad, v_cap_mps, in);
    if (by_rad != 0.0) {
      turning_ = by_rad == turn_rad;
      FollowOutput turned = turn(by_rad, in);
      turned.turn_rad = turn_rad;
      return turned;
    }
  }
  out.blocked = best.v_mps < rules_.crawl_mps;
  if (out.blocked) return out;
  last_curvature_ = best.curvature;
  out.twist = {best.v_mps, best.v_mps * best.curvature};
  return out;
}

FollowOutput PathFollower::turn_to(double heading_rad, const FollowInput& in) {
  reset();
  const double turn_rad = types::wrap_angle(heading_rad - in.T_odom_base.theta_rad);
  if (std::abs(turn_rad) > rules_.turn.end_rad) return turn(turn_rad, in);
  FollowOutput out;
  out.arrived = true;
  return out;
}

FollowOutput PathFollower::step(const FollowInput& in) {
  FollowOutput out;
  if (in.limits == nullptr) return out;
  if (in.turn_to_rad) return turn_to(*in.turn_to_rad, in);
  if (in.path_odom.empty()) return out;
  take_path(in);
  const double rest_m = s_m_[points_ - 1] - here_.s_m;
  const Vector2 end_base = in.T_odom_base.inverse() * path_[points_ - 1];
  const ArrivalParams& p = rules_.arrival;
  const bool at_end = rest_m < p.along_m && end_base.norm() < p.off_factor * p.along_m;
  const bool passed_end = rest_m < p.along_m && end_base.norm() < p.passed_m && end_base.x() < 0.0;
  if (at_end || passed_end || end_base.norm() < p.along_m) {
    out.arrived = in.ends_at_goal;
    turning_ = false;
    return out;
  }
  const Vector2 ahead =
      in.T_odom_base.inverse() * point_at(here_.s_m + std::max(rules_.lookahead_m, here_.distance_m));
  const double turn_rad = std::atan2(ahead.y(), ahead.x());
  turning_ = std::abs(turn_rad) > (turning_ ? rules_.turn.end_rad : rules_.turn.begin_rad);
  return turning_ ? turn(turn_rad, in) : drive(turn_rad, rest_m, in);
}

}  // namespace topo::motion

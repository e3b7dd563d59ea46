// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/velocity_gate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/motion/giving_way.hpp"
#include "core/perception/footprint_sweep.hpp"
#include "core/types/watchdog.hpp"

namespace topo::motion {
namespace {

using types::Duration;
using types::Stamp;
using types::Twist2;

// Tolerance: threads of one clock stamp what they hand over within their scheduling jitter.
constexpr Duration kFutureMax = std::chrono::milliseconds(20);

bool is_finite_twist(const Twist2& t) { return std::isfinite(t.v_mps) && std::isfinite(t.omega_radps); }

std::optional<GateReason> request_fault(const GateInput& in) {
  if (is_stale(in.request.stamp, in.now, in.limits.request_age_max)) return GateReason::kStaleRequest;
  if (!is_finite_twist(in.request.twist)) return GateReason::kInvalidRequest;
  if (in.request.twist.v_mps < 0.0 && !in.limits.allow_reverse && in.backing == Backing::kNone)
    return GateReason::kReverse;
  return std::nullopt;
}

/// True for a reverse motion along the breadcrumb path, where the hull has just been: it may leave a touch.
bool backs_along_trail(const GateInput& in) {
  return in.backing == Backing::kAlongTrail && in.request.twist.v_mps <= 0.0;
}

/// True when the robot may creep off an obstacle at its rear bumper: forwards, without contact in front,
/// under manual control.
bool creeps_off(const GateInput& in) {
  return in.base->bumpers_rear != 0 && in.by_hand && in.request.twist.v_mps > 0.0 &&
         in.base->bumpers_front == 0;
}

std::optional<GateReason> base_fault(const GateInput& in) {
  if (in.base == nullptr || is_stale(in.base->arrival, in.now, in.limits.status_age_max))
    return GateReason::kStaleStatus;
  if (!is_finite(*in.base)) return GateReason::kInvalidStatus;
  const bool leaves = backs_along_trail(in);
  if ((in.base->stall_left || in.base->stall_right) && !leaves) return GateReason::kStall;
  if (in.base->bumpers_rear != 0 && !creeps_off(in)) return GateReason::kBumper;
  if (in.base->bumpers_front != 0 && !leaves) return GateReason::kBumper;
  return std::nullopt;
}

std::optional<GateReason> scan_fault(const GateInput& in) {
  if (in.front_scan == nullptr ||
      is_stale(in.front_scan->arrival, in.now, scan_age_max(*in.front_scan, in.params.scan)))
    return GateReason::kStaleScan;
  // Fails as well for a mount whose heading is not finite: it has no forward beams.
  if (!(perception::forward_valid_fraction(*in.front_scan, in.T_base_laser, in.stop_zone) >=
        in.params.valid_share_min))
    return GateReason::kBlindScan;
  const types::Se2& mount = in.T_base_laser;
  if (!std::isfinite(mount.x_m) || !std::isfinite(mount.y_m)) return GateReason::kBlindScan;
  return std::nullopt;
}

bool has_area(const GateInput& in) { return in.area != nullptr && !in.area->empty(); }

std::optional<GateReason> place_fault(const GateInput& in) {
  if (in.place == types::PlaceStanding::kProposed) return GateReason::kPlaceProposed;
  if (in.place == types::PlaceStanding::kDropped) return GateReason::kPlaceDropped;
  if (!has_area(in)) return std::nullopt;
  const bool known = in.T_map_base && std::isfinite(in.T_map_base->x_m) &&
                     std::isfinite(in.T_map_base->y_m) && std::isfinite(in.T_map_base->theta_rad);
  return known ? std::nullopt : std::optional(GateReason::kNoPlace);
}

/// The reason that forbids motion, the gravest first.
std::optional<GateReason> first_fault(const GateState& state, const GateInput& in) {
  if (state.estop_latched) return GateReason::kEmergencyStop;
  if (!types::is_valid(in.limits)) return GateReason::kInvalidLimits;
  if (!types::is_watchdog_safe(in.firmware_watchdog)) return GateReason::kNoWatchdog;
  if (in.doubts.any()) return GateReason::kImplausible;
  if (const auto fault = base_fault(in)) return fault;
  if (const auto fault = scan_fault(in)) return fault;
  if (const auto fault = place_fault(in)) return fault;
  return request_fault(in);
}

double elapsed_s(const GateState& state, Stamp now, double most_s) {
  if (state.last_stamp == Stamp{} || now <= state.last_stamp) return 0.0;
  return std::min(types::to_seconds(now - state.last_stamp), most_s);
}

/// Stays on the requested arc from the start: rotation reaches its speed long before translation does, and a
/// robot that begins an arc by turning on the spot turns into obstacles beside the arc.
Twist2 ramped_twist(const GateState& state, const Twist2& wanted, const GateInput& in) {
  const double dt_s = elapsed_s(state, in.now, in.params.elapsed_max_s);
  const types::RobotLimits& l = in.limits;
  const double v_mps = ramped(state.last.v_mps, wanted.v_mps, l.acceleration_mps2, l.deceleration_mps2, dt_s);
  const double part = wanted.v_mps != 0.0 ? std::clamp(v_mps / wanted.v_mps, 0.0, 1.0) : 1.0;
  return {v_mps, ramped(state.last.omega_radps, part * wanted.omega_radps, l.angular_acceleration_radps2,
                        l.angular_acceleration_radps2, dt_s)};
}

/// Slow enough to brake when a wheel slips, with a live daemon: with the watchdog's time included, the robot
/// could not move between walls.
double slip_scale(const Twist2& next, const GateInput& in) {
  if (!(next.v_mps > in.limits.v_beside_mps)) return 1.0;
  const double free_s = perception::slip_free_time_s(next, in.limits, surroundings(in));
  const double scale = stopping_scale(next, free_s, alive_time_s(in), in.limits);
  return std::max(scale, in.limits.v_beside_mps / next.v_mps);
}

/// A wheel that slips during a turn on the spot displaces the robot. The scanner observes an obstacle ahead
/// coming nearer; behind, only the next match against the map shows it. The displacement until then must fit
/// into the gap.
double turn_slip_scale(const Twist2& next, const GateInput& in) {
  const double turn_radps = std::abs(next.omega_radps);
  if (!perception::is_on_the_spot(next, in.stop_zone) || turn_radps <= in.limits.omega_beside_radps)
    return 1.0;
  const double aside_m = turn_radps * in.limits.slip_aside_m_per_rad * in.params.unnoticed_slip_s;
  const double scale = perception::remembered_gap_m(in.limits, surroundings(in), aside_m) / aside_m;
  return std::max(scale, in.limits.omega_beside_radps / turn_radps);
}

/// True when an obstacle appeared nearer than the normal braking distance: the firmware's emergency stop
/// brakes several times as hard.
bool must_brake_hard(const GateInput& in) {
  const GateParams& p = in.params;
  const Twist2& measured = in.base->odometry.twist;
  if (!(measured.v_mps > p.late_from_mps)) return false;
  const Twist2 slower{p.late_share * measured.v_mps, p.late_share * measured.omega_radps};
  if (!stands_in_time(slower, in.moving, alive_time_s(in), 0.0, in.limits, p.giving_way)) return true;
  types::RobotLimits bare = in.limits;
  bare.margin_m = 0.0;
  const double free_s = perception::free_time_s(measured, bare, surroundings(in));
  return stopping_scale(measured, free_s, alive_time_s(in), in.limits) < p.late_share;
}

void decide_motion(const GateState& state, const GateInput& in, GateOutput& out) {
  if (must_brake_hard(in)) {
    out.command.estop = true;
    out.reason = GateReason::kBlocked;
    return;
  }
  const Twist2 wanted = within_limits(in.request.twist, in.limits);
  Twist2 next = ramped_twist(state, wanted, in);
  // Straight, because a turn swings the rear into the obstacle; the rotation stops at once, without the ramp.
  if (creeps_off(in)) next = {std::min(next.v_mps, in.limits.v_reverse_max_mps), 0.0};
  const double blind_s = blind_time_s(in);
  const double free_s = perception::free_time_s(next, in.limits, surroundings(in));
  out.free_distance_m = perception::free_distance_m(next, free_s);
  double scale = stopping_scale(next, free_s, blind_s, in.limits);
  scale = std::min({scale, slip_scale(next, in), turn_slip_scale(next, in)});
  // With a live daemon, as for obstacles that wheel slip may touch.
  const double yielding =
      giving_way_scale(next, in.moving, alive_time_s(in), in.limits, in.params.giving_way);
  const bool gives_way = yielding < scale;
  scale = std::min(scale, yielding);
  bool at_edge = false;
  if (has_area(in) && scale > 0.0) {
    const Twist2 clear{next.v_mps * scale, next.omega_radps * scale};
    const double until_s = blind_s + 0.5 * std::abs(clear.v_mps) / in.limits.deceleration_mps2 +
                           0.5 * std::abs(clear.omega_radps) / in.limits.angular_acceleration_radps2;
    const double allowed_s = types::area_free_time_s(
        *in.area, *in.T_map_base, clear, types::grown(in.limits.footprint, in.limits.margin_m), until_s);
    const double part = stopping_scale(clear, allowed_s, blind_s, in.limits);
    at_edge = part < 1.0;
    scale *= part;
  }
  const Twist2 safe{next.v_mps * scale, next.omega_radps * scale};
  const bool creeps = std::abs(safe.v_mps) < in.params.standstill_mps &&
                      std::abs(safe.omega_radps) < in.params.standstill_radps;
  if (scale < 1.0 && creeps) {
    out.reason = at_edge ? GateReason::kAreaLimit : gives_way ? GateReason::kGivesWay : GateReason::kBlocked;
    return;
  }
  out.command.twist = safe;
  if (scale < 1.0)
    out.reason = GateReason::kSlowed;
  else
    out.reason = safe == in.request.twist ? GateReason::kFree : GateReason::kLimited;
}

}  // namespace

bool is_stale(Stamp stamp, Stamp now, Duration age_max) {
  return stamp == Stamp{} || now - stamp > age_max || stamp - now > kFutureMax;
}

Duration scan_age_max(const types::Scan& scan, const ScanAgeParams& params) {
  const double period_s = static_cast<double>(scan.geometry.period_s);
  if (!(period_s > 0.0 && period_s <= params.period_max_s)) return params.age_max;
  return std::max(params.age_max, types::from_seconds(params.periods * period_s));
}

double alive_time_s(const GateInput& in) {
  const types::Scan& scan = *in.front_scan;
  const Duration age = std::max(in.now - scan.first_beam, in.now - scan.arrival + scan.late);
  // A stamp of the first beam that is missing or in the future does not give the age.
  const Duration bounded = std::clamp(age, Duration::zero(), in.params.first_beam_age_max);
  return types::to_seconds(bounded + std::max(in.limits.reaction, in.lag) + types::kBasePeriod);
}

double blind_time_s(const GateInput& in) {
  return alive_time_s(in) + types::to_seconds(in.firmware_watchdog - types::kBasePeriod);
}

perception::Surroundings surroundings(const GateInput& in) {
  return {.front_scan = in.front_scan,
          .T_base_laser = in.T_base_laser,
          .points = in.front_points,
          .sonar = in.base->sonar,
          .T_base_sonar = in.T_base_sonar,
          .now = in.now,
          .backing_off = backs_along_trail(in),
          .params = in.stop_zone};
}

bool is_finite(const types::BaseState& base) {
  const types::Se2& pose = base.odometry.T_odom_base.se2();
  return is_finite_twist(base.odometry.twist) && std::isfinite(pose.x_m) && std::isfinite(pose.y_m) &&
         std::isfinite(pose.theta_rad);
}

void update_latch(GateState& state, const GateInput& in) {
  const bool pressed = in.estop_pressed || (in.base != nullptr && in.base->stop_button);
  if (in.estop_cleared) state.estop_latched = false;
  if (pressed) state.estop_latched = true;
}

Twist2 within_limits(const Twist2& twist, const types::RobotLimits& limits) {
  const double v_max_mps =
      twist.v_mps < 0.0 ? std::min(limits.v_reverse_max_mps, limits.v_max_mps) : limits.v_max_mps;
  double scale = 1.0;
  if (std::abs(twist.v_mps) > v_max_mps) scale = v_max_mps / std::abs(twist.v_mps);
  if (std::abs(twist.omega_radps) * scale > limits.omega_max_radps)
    scale = limits.omega_max_radps / std::abs(twist.omega_radps);
  return {std::clamp(twist.v_mps * scale, -v_max_mps, v_max_mps),
          std::clamp(twist.omega_radps * scale, -limits.omega_max_radps, limits.omega_max_radps)};
}

double ramped(double last, double wanted, double acceleration, double deceleration, double elapsed_s) {
  const double faster = acceleration * elapsed_s, slower = deceleration * elapsed_s;
  if (last > 0.0 && wanted < last) return std::max({wanted, last - slower, 0.0});
  if (last < 0.0 && wanted > last) return std::min({wanted, last + slower, 0.0});
  return std::clamp(wanted, last - faster, last + faster);
}

double stopping_scale(const Twist2& twist, double free_s, double blind_s, const types::RobotLimits& limits) {
  if (!(free_s > 0.0)) return 0.0;
  // Braking distance in seconds of full speed: v / 2a, of the component that brakes longer.
  const double braking_s = std::max(std::abs(twist.v_mps) / (2.0 * limits.deceleration_mps2),
                                    std::abs(twist.omega_radps) / (2.0 * limits.angular_acceleration_radps2));
  if (blind_s + braking_s <= free_s) return 1.0;
  // Solves s (blind + s braking) = free, in the form that stays exact for short braking.
  const double root = std::sqrt(blind_s * blind_s + 4.0 * braking_s * free_s);
  return std::clamp(2.0 * free_s / (blind_s + root), 0.0, 1.0);
}

GateOutput gate(GateState& state, const GateInput& input) {
  update_latch(state, input);
  GateOutput out;
  out.command.estop = state.estop_latched;
  const bool asked = !is_stale(input.request.stamp, input.now, input.limits.request_age_max);
  const bool kept_off =
      state.estop_latched || plausibility::has(input.doubts, plausibility::Doubt::kMotorsOff);
  out.command.enable_motors = asked && input.request.enable_motors && !kept_off;
  if (plausibility::has(input.doubts, plausibility::Doubt::kDisobeys)) out.command.silence = true;
  if (const auto fault = first_fault(state, input))
    out.reason = *fault;
  else
    decide_motion(state, input, out);
  state.last = out.command.twist;
  state.last_stamp = input.now;
  return out;
}

std::string_view to_text(GateReason reason) {
  switch (reason) {
    case GateReason::kFree:
      return "as requested";
    case GateReason::kLimited:
      return "limited by the robot's velocity or acceleration";
    case GateReason::kSlowed:
      return "slowed by an obstacle ahead";
    case GateReason::kBlocked:
      return "stopped: an obstacle is too near";
    case GateReason::kEmergencyStop:
      return "stopped: emergency stop, to be cleared by the operator";
    case GateReason::kInvalidLimits:
      return "stopped: the robot's limits are not valid";
    case GateReason::kNoWatchdog:
      return "stopped: the firmware's watchdog is off, unknown or over 2 s";
    case GateReason::kStaleRequest:
      return "stopped: no fresh request";
    case GateReason::kInvalidRequest:
      return "stopped: the request is not a number";
    case GateReason::kStaleStatus:
      return "stopped: no fresh status from the robot";
    case GateReason::kInvalidStatus:
      return "stopped: the robot's status is not a number";
    case GateReason::kStall:
      return "stopped: a wheel is stalled";
    case GateReason::kBumper:
      return "stopped: a bumper is pressed";
    case GateReason::kStaleScan:
      return "stopped: no fresh scan from the front laser";
    case GateReason::kBlindScan:
      return "stopped: most of the front laser's forward beams are invalid";
    case GateReason::kReverse:
      return "stopped: reversing is not allowed, the rear is blind";
    case GateReason::kAreaLimit:
      return "stopped: the edge of the allowed area is too near";
    case GateReason::kNoPlace:
      return "stopped: there are area limits, and the robot's place is not known";
    case GateReason::kPlaceProposed:
      return "stopped: the robot's place in the session's map is a proposal (topoctl session confirm)";
    case GateReason::kPlaceDropped:
      return "stopped: the first metres did not match the session's map, the robot's place is not known";
    case GateReason::kGivesWay:
      return "stopped: gives way to something that moves";
    case GateReason::kImplausible:
      return "stopped: what is commanded, measured and seen does not agree";
  }
  return "unknown";
}

}  // namespace topo::motion

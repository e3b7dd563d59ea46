// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/motion/backing.hpp"
#include "core/perception/moving_obstacle.hpp"
#include "core/perception/stop_zone.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/base_state.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

// The base thread's last word on every velocity (DESIGN "Motion and safety"). Pure: time comes in as a value.
namespace topo::motion {

enum class GateReason {
  kFree,           ///< as requested
  kLimited,        ///< by the model's velocity or acceleration
  kSlowed,         ///< by what is ahead
  kBlocked,        ///< too near to move at all
  kEmergencyStop,  ///< latched until the operator clears it; the stop button latches it too
  kInvalidLimits,
  kNoWatchdog,  ///< the firmware's is 0, unknown or over 2 s
  kStaleRequest,
  kInvalidRequest,  ///< not finite
  kStaleStatus,
  kInvalidStatus,
  kStall,
  kBumper,
  kStaleScan,
  kBlindScan,  ///< fewer than half of the forward beams are valid
  kReverse,    ///< the rear is blind
  kAreaLimit,  ///< the edge of the allowed area is too near
  kNoPlace,    ///< there are area limits, and nobody knows where the robot is
  kGivesWay,   ///< something that moves comes across the way
};

/// One sentence for a person.
std::string_view to_text(GateReason reason);

struct MotionRequest {
  types::Twist2 twist;
  bool enable_motors = false;
  types::Stamp stamp{};  ///< when it was asked for
};

/// Pointers and spans are borrowed for the call; null: never received.
struct GateInput {
  types::Stamp now{};
  MotionRequest request;
  const types::BaseState* base = nullptr;
  const types::Scan* front_scan = nullptr;
  types::Se2 T_base_laser;
  std::span<const perception::ScanPoint> front_points;  ///< as Surroundings::points
  std::span<const perception::MovingObstacle> moving;   ///< in base, at the scan's first beam
  std::span<const types::Se2> T_base_sonar;
  bool estop_pressed = false;
  bool estop_cleared = false;  ///< by the operator, in this period; does nothing while something is pressed
  types::Duration firmware_watchdog{};
  types::RobotLimits limits;
  /// Of the request. A rear bumper stops it all the same.
  Backing backing = Backing::kNone;
  /// The request is that of a person who sees the robot: it may creep straight forwards off a pressed rear
  /// bumper. By itself a robot stands then: who or what is behind it, it cannot see.
  bool by_hand = false;
  const types::AreaLimits* area = nullptr;  ///< null or empty: none
  std::optional<types::Se2> T_map_base;     ///< now; needed when there are area limits
};

struct GateState {
  bool estop_latched = false;
  types::Twist2 last;  ///< given out in the last period
  types::Stamp last_stamp{};
};

struct GateOutput {
  types::BaseCommand command;
  GateReason reason = GateReason::kFree;
  double free_distance_m = 0.0;  ///< ahead on the requested arc; 0 when it was not looked at
};

/// Motion only when everything that it rests on is fresh, finite and clear.
GateOutput gate(GateState& state, const GateInput& input);

// The decisions, each by itself.

/// Older than `age_max`, never given (the zero stamp), or from the future by more than a scheduling jitter.
bool is_stale(types::Stamp stamp, types::Stamp now, types::Duration age_max);
/// By arrival: the greater of 150 ms and two and a half periods.
types::Duration scan_age_max(const types::Scan& scan);
/// How long the robot may go on at a twist after this period: until the firmware's watchdog bites, plus the
/// age of what the scan shows and the time until the wheels react. Needs input.front_scan.
double blind_time_s(const GateInput& input);
/// The same with a daemon that lives: until the next period's command.
double alive_time_s(const GateInput& input);
bool is_finite(const types::BaseState& base);
void update_latch(GateState& state, const GateInput& input);
/// Both parts scaled alike, so that the arc stays the same.
types::Twist2 within_limits(const types::Twist2& twist, const types::RobotLimits& limits);
/// Towards `wanted`: faster with the acceleration, slower with the deceleration, through zero in two steps.
double ramped(double last, double wanted, double acceleration, double deceleration, double elapsed_s);
/// Surroundings of a gate's input; base and scan must be there.
perception::Surroundings surroundings(const GateInput& input);
/// The part of a twist after which the robot still stands before contact: with scale s it goes on for the
/// blind time (firmware watchdog, age of the scan, reaction) and then brakes. Between 0 and 1, growing with
/// free_time_s.
double stopping_scale(const types::Twist2& twist, double free_time_s, double blind_s,
                      const types::RobotLimits& limits);

}  // namespace topo::motion

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/motion/backing.hpp"
#include "core/motion/params.hpp"
#include "core/perception/moving_obstacle.hpp"
#include "core/perception/stop_zone.hpp"
#include "core/plausibility/doubt.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/base_state.hpp"
#include "core/types/place_standing.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

// Final check of every velocity, in the base thread (DESIGN "Motion and safety"). Pure: the time is a
// parameter.
namespace topo::motion {

enum class GateReason {
  kFree,           ///< as requested
  kLimited,        ///< by the model's velocity or acceleration
  kSlowed,         ///< by an obstacle ahead
  kBlocked,        ///< an obstacle is too near for any motion
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
  kBlindScan,      ///< too few of the forward beams are valid (GateParams::valid_share_min)
  kReverse,        ///< the rear is blind
  kAreaLimit,      ///< the edge of the allowed area is too near
  kNoPlace,        ///< there are area limits, and the robot's pose is unknown
  kPlaceProposed,  ///< the robot's place in a map that goes on waits for the operator's word
  kPlaceDropped,   ///< the first metres did not match the map that goes on
  kGivesWay,       ///< a moving obstacle crosses the path
  kImplausible,    ///< a doubt: GateInput::doubts
};

/// Text for the user.
std::string_view to_text(GateReason reason);

struct MotionRequest {
  types::Twist2 twist;
  bool enable_motors = false;
  types::Stamp stamp{};  ///< time of the request
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
  bool estop_cleared = false;  ///< by the operator, in this period; without effect while a stop is pressed
  types::Duration firmware_watchdog{};
  plausibility::DoubtSet doubts;  ///< any of them stops the robot
  types::Duration lag{};          ///< measured, from a command to the wheels
  types::RobotLimits limits;
  /// Of the request. A pressed rear bumper stops it nevertheless.
  Backing backing = Backing::kNone;
  /// The request comes from an operator in sight of the robot: it may creep straight forwards off a pressed
  /// rear bumper. Otherwise the robot stays stopped then, because it cannot see what is behind it.
  bool by_hand = false;
  const types::AreaLimits* area = nullptr;  ///< null or empty: none
  std::optional<types::Se2> T_map_base;     ///< now; needed when there are area limits
  types::PlaceStanding place = types::PlaceStanding::kKnown;
  GateParams params;
  perception::StopZoneParams stop_zone;
};

struct GateState {
  bool estop_latched = false;
  types::Twist2 last;  ///< output of the last period
  types::Stamp last_stamp{};
};

struct GateOutput {
  types::BaseCommand command;
  GateReason reason = GateReason::kFree;
  double free_distance_m = 0.0;  ///< ahead on the requested arc; 0 when not computed
};

/// Allows motion only when all inputs are fresh, finite and clear.
GateOutput gate(GateState& state, const GateInput& input);

// Individual decisions.

/// True when older than `age_max`, never set (the zero stamp), or in the future by more than scheduling
/// jitter.
bool is_stale(types::Stamp stamp, types::Stamp now, types::Duration age_max);
/// Maximum age by arrival.
types::Duration scan_age_max(const types::Scan& scan, const ScanAgeParams& params);
/// Time for which the robot may continue at a twist after this period: until the firmware's watchdog fires,
/// plus the age of the scan and the time until the wheels react. Needs input.front_scan.
double blind_time_s(const GateInput& input);
/// The same with a live daemon: until the next period's command.
double alive_time_s(const GateInput& input);
bool is_finite(const types::BaseState& base);
void update_latch(GateState& state, const GateInput& input);
/// Scales both components alike, so that the arc stays the same.
types::Twist2 within_limits(const types::Twist2& twist, const types::RobotLimits& limits);
/// Towards `wanted`: speeds up with the acceleration, slows down with the deceleration, passes through zero
/// in two steps.
double ramped(double last, double wanted, double acceleration, double deceleration, double elapsed_s);
/// Surroundings of a gate's input; base must not be null.
perception::Surroundings surroundings(const GateInput& input);
/// Scale of a twist at which the robot still stands before contact: with scale s it continues for the blind
/// time (firmware watchdog, age of the scan, reaction) and then brakes. Between 0 and 1, growing with
/// free_time_s.
double stopping_scale(const types::Twist2& twist, double free_time_s, double blind_s,
                      const types::RobotLimits& limits);

}  // namespace topo::motion

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/motion/velocity_gate.hpp"
#include "core/pipeline/control_params.hpp"
#include "core/pipeline/plan.hpp"
#include "core/plausibility/plausibility.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/base_state.hpp"
#include "core/types/place_standing.hpp"
#include "core/types/scan.hpp"
#include "core/types/sector.hpp"

namespace topo::pipeline {

/// Constant while the daemon runs.
struct ControlSetup {
  types::RobotLimits limits;
  types::Se2 T_base_laser;  ///< front scanner
  types::AreaLimits area;   ///< of the configuration
  types::Duration plan_age_max = std::chrono::seconds(1);
  types::ModelSize model = types::kP3dx;
  bool disobeyed = false;  ///< the base did not obey when the daemon ended (Plausibility)
};

/// Manual control by the operator, with a dead man's switch (limits.request_age_max). Overrides the plan.
struct Teleop {
  types::Stamp stamp{};
  types::Twist2 twist;
};

/// Input of the base thread, once per period. Pointers: the newest of each, null when there is none.
struct ControlInput {
  types::Stamp now{};
  bool estop = false;
  bool estop_cleared = false;  ///< since the last period
  const Teleop* teleop = nullptr;
  const Plan* plan = nullptr;
  const types::BaseState* state = nullptr;
  const types::Scan* front = nullptr;
  const plausibility::MatchedMotion* matched = nullptr;
  types::PlaceStanding place = types::PlaceStanding::kKnown;  ///< of the plan's T_map_odom
  std::span<const types::Se2> T_base_sonar;
  types::Duration firmware_watchdog{};
  /// The watchdog is claimed and being measured: nothing but a slow turn on the spot by hand is wished.
  bool watchdog_on_trial = false;
  double firmware_deceleration_mps2 = 0.0;  ///< the most that it brakes with; 0: unknown
  bool base_released = false;               ///< plausibility::Evidence::base_released
  const types::AreaLimits* area = nullptr;  ///< all that are in force; null: the configuration's alone
};

enum class ControlMode : std::uint8_t {
  kStanding,  ///< no motion is requested
  kTeleop,
  kFollowing,   ///< the plan's path
  kArrived,     ///< at the end of a path that ends at its goal
  kWaiting,     ///< an obstacle is in the way; it may move away by itself
  kRecovering,  ///< backing off along the breadcrumb path, turning free
  kStuck,       ///< recovery did not help: planning has to give up the goal
};
std::string_view to_text(ControlMode mode);

/// What control reports to planning and main.
struct ControlReport {
  types::Stamp stamp{};
  ControlMode mode = ControlMode::kStanding;
  std::uint64_t goal_id = 0;  ///< of the plan to which `mode` refers
  motion::GateReason reason = motion::GateReason::kStaleStatus;
  types::Odometry odometry;  ///< the newest
  bool base_ready = false;   ///< status packets are fresh and plausible
  bool estop_latched = false;
  /// Number of times since the start that a bumper was pressed or a wheel stalled. Planning runs less often
  /// than control: with a count it misses none.
  std::uint32_t touches = 0;
  types::Vector2 touched_odom{0.0, 0.0};  ///< position of the last touch; without meaning before the first
  float battery_v = 0.0F;
  float state_of_charge = -1.0F;  ///< 0..1; negative: not reported
  types::Twist2 commanded;
  double free_distance_m = 0.0;
  plausibility::Opinion plausibility;
  std::uint32_t recoveries = 0;  ///< begun since the start
  /// Where sonar detects something that the laser does not (perception::unseen_echoes), in odom.
  std::array<types::Vector2, 8> unseen_odom{};
  std::uint8_t unseen = 0;
  /// Where the front scanner steadily sees something within the robot's own outline (perception::OwnEcho).
  std::optional<types::Sector> own_echo;
};

struct ControlOutput {
  types::BaseCommand command;
  ControlReport report;
};

/// State kept from one period to the next: ramps, the e-stop's latch, the last metre driven, the recovery.
/// Allocates in the constructor only.
class ControlState {
 public:
  /// `disobeyed`: ControlSetup::disobeyed.
  explicit ControlState(const ControlParams& params = {}, bool disobeyed = false);
  ~ControlState();
  ControlState(const ControlState&) = delete;
  ControlState& operator=(const ControlState&) = delete;

 private:
  friend ControlOutput control_step(ControlState&, const ControlSetup&, const ControlInput&);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One period of the base thread (DESIGN "Motion and safety"): follows the operator's manual control, else
/// the plan, else stands. The velocity gate has the last decision on every command. Anything stale, unknown
/// or contradictory gives zero velocity. Allocates nothing.
ControlOutput control_step(ControlState& state, const ControlSetup& setup, const ControlInput& input);

}  // namespace topo::pipeline

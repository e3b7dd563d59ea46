// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "tests/sim/devices/arcos_model.hpp"

namespace topo::sim::arcos {

struct WheelTargets {
  double left_mps = 0.0;
  double right_mps = 0.0;
};

/// The firmware's own dead reckoning, which closes the loops of MOVE and HEAD.
struct Reckoning {
  double way_mm = 0.0;       ///< driven since the start, backwards negative
  double heading_deg = 0.0;  ///< wrapped
};

/// The firmware's motion: setpoints, working limits, first-order ramps (PROTOCOLS sections 3 and 8).
/// Setpoints persist: while the watchdog stops the robot, `hold` of step() overrides them. MOVE and VEL
/// replace each other, and so do HEAD and RVEL; VEL2 replaces all, and any of them replaces what VEL2 set.
class Drive {
 public:
  explicit Drive(const Parameters& parameters);

  void set_velocity(int mm_s);                         ///< VEL
  void set_rotation(int deg_s);                        ///< RVEL
  void set_wheels(int left_counts, int right_counts);  ///< VEL2
  void move(int mm, const Reckoning& at);              ///< MOVE, at SETV
  void turn_to(double heading_deg);                    ///< HEAD, the shorter way, at SETRV
  void turn_by(double deg, const Reckoning& at) { turn_to(at.heading_deg + deg); }  ///< DHEAD
  void turn_on(double deg, const Reckoning& at);                                    ///< DCHEAD
  void origin_set(const Reckoning& before);  ///< SETO: the heading became 0, where the robot turns did not
  void stop();                               ///< STOP: setpoints 0, normal deceleration
  void emergency_stop();             ///< E_STOP: setpoints 0, greatest deceleration; ignores setpoints until
                                     ///< it stands
  void set_max_velocity(int mm_s);   ///< SETV
  void set_max_rotation(int deg_s);  ///< SETRV
  void set_acceleration(int mm_s2);  ///< SETA, negative: deceleration
  void set_rotation_acceleration(int deg_s2);  ///< SETRA
  /// Resets the working values to FLASH, and the setpoints to 0.
  void revert();
  /// Stops at once (motors off); the setpoints stay.
  void stand();
  /// The wheels are blocked: the ramps restart from the actual speeds.
  void blocked(double velocity_mm_s, double rotation_deg_s);

  /// Ramps towards the setpoints, or towards 0 when held.
  WheelTargets step(double dt_s, bool hold, const Reckoning& at);

  [[nodiscard]] bool moving() const { return velocity_mm_s_ != 0.0 || rotation_deg_s_ != 0.0; }
  [[nodiscard]] double velocity_setpoint_mm_s() const { return velocity_setpoint_; }

 private:
  void leave_wheels();
  void approach_goals(const Reckoning& at);

  const Parameters flash_;
  Parameters working_;
  double velocity_setpoint_ = 0.0;
  double rotation_setpoint_ = 0.0;
  double velocity_mm_s_ = 0.0;
  double rotation_deg_s_ = 0.0;
  bool emergency_ = false;
  bool by_wheels_ = false;  ///< the setpoints are those of VEL2
  std::optional<double> way_goal_mm_;
  std::optional<double> heading_goal_deg_;
  std::optional<double> last_heading_goal_deg_;  ///< also after RVEL, for DCHEAD
};

}  // namespace topo::sim::arcos

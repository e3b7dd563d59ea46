// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"
#include "core/types/wheel_calibration.hpp"
#include "drivers/pioneer/robot_models.hpp"
#include "drivers/pioneer/sip.hpp"

namespace topo::pioneer {

/// Combines the robot's wrapping counters (PROTOCOLS section 4.1) into one continuous pose in odom, across
/// wrap-arounds, reconnects and resets of the controller.
class DeadReckoning {
 public:
  enum class Update {
    kInitialised,  ///< first packet of a connection: the pose stays, independent of the counters
    kMoved,
    kJumped,  ///< farther than the robot can move: the counters were reset, the pose stays
  };

  /// The next packet only initialises. `v_max_mps` and `omega_max_radps` are the robot's physical limits;
  /// `wheels`: how this robot differs from its model.
  void restart(const RobotModel& model, double v_max_mps, double omega_max_radps,
               const types::WheelCalibration& wheels = {});

  /// `elapsed`: time since the previous received packet, including that of lost packets. `gyro_turn_rad`:
  /// the turn in that time by a gyro, in place of the wheels'.
  Update update(const StatusPacket& packet, types::Duration elapsed,
                std::optional<double> gyro_turn_rad = std::nullopt);

  /// True when the packet's counters are those of the packet before.
  [[nodiscard]] bool stands(const StatusPacket& packet) const;

  [[nodiscard]] const types::Se2& T_odom_base() const { return pose_; }

 private:
  struct Counts {
    int x = 0, y = 0, heading = 0;
  };
  [[nodiscard]] bool possible(double distance_m, double turn_rad, types::Duration elapsed) const;
  void initialise(const Counts& counts);
  void move(double dx_m, double dy_m, double turn_rad, std::optional<double> gyro_turn_rad);

  RobotModel model_;
  types::WheelCalibration wheels_;
  double v_max_mps_ = 0.0;
  double omega_max_radps_ = 0.0;
  bool initialised_ = false;
  Counts last_;
  double T_odom_robot_theta_rad_ = 0.0;  ///< heading of the robot's own frame, in which its counters run
  types::Se2 pose_;
};

/// Shortest difference from `before` to `now` of a counter of `modulus` values, in [-modulus/2, modulus/2).
int counter_difference(int now, int before, int modulus);

}  // namespace topo::pioneer

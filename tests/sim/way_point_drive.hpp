// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tests/sim/simulation.hpp"

namespace topo::sim {

/// Drives along way-points by the true pose, like manual control: turns on the spot when the next point is
/// far off the heading, ramps the speed, slows down before a point. For tests and recordings, not for
/// devices.
class WayPointDrive final : public WheelDrive {
 public:
  struct Limits {
    double v_max_mps = 0.5;
    double omega_max_radps = 0.8;
    double acceleration_mps2 = 0.5;
    double angular_acceleration_radps2 = 2.0;
    double arrived_m = 0.15;
  };
  /// `laps`: number of rounds over the points; 0: endless.
  WayPointDrive(std::vector<Vector2> points, int laps) : WayPointDrive(std::move(points), laps, Limits{}) {}
  WayPointDrive(std::vector<Vector2> points, int laps, const Limits& limits);

  WheelSpeeds wheel_speeds(SimTime now, SimTime dt, const RobotBody& body) override;
  [[nodiscard]] bool finished() const { return finished_; }

 private:
  std::vector<Vector2> points_;
  int laps_left_;
  bool for_ever_;
  Limits limits_;
  std::size_t next_ = 0;
  bool finished_ = false;
  double v_mps_ = 0.0;
  double omega_radps_ = 0.0;
};

/// A robot's dead reckoning from its encoders, with the track that its firmware uses.
class DeadReckoning {
 public:
  DeadReckoning(const Se2& start, double track_m) : pose_(start), track_m_(track_m) {}
  void update(const RobotBody& body);
  [[nodiscard]] const Se2& pose() const { return pose_; }

 private:
  Se2 pose_;
  double track_m_;
  double left_m_ = 0.0;
  double right_m_ = 0.0;
};

}  // namespace topo::sim

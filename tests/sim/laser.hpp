// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/types/stamp.hpp"
#include "tests/sim/difficulty.hpp"
#include "tests/sim/robot_body.hpp"
#include "tests/sim/world.hpp"

namespace topo::sim {

/// Constants of one Hokuyo model (PROTOCOLS sections 10.2, 10.3 and 11).
struct LaserModel {
  std::string name;     ///< "UTM-30LX"
  int steps_per_turn;   ///< ARES
  int step_min;         ///< AMIN
  int step_max;         ///< AMAX
  int step_front;       ///< AFRT
  int distance_min_mm;  ///< DMIN
  int distance_max_mm;  ///< DMAX
  int rpm;              ///< SCAN
  double range_max_m;   ///< no return beyond this range
  std::uint32_t code_no_return;
  std::uint32_t code_too_near;
  std::uint32_t code_failed;

  static LaserModel utm_30lx();     ///< USB
  static LaserModel utm_30lx_ew();  ///< Ethernet
  static LaserModel ust_10lx();
  static LaserModel ust_20lx();
  static LaserModel urg_04lx();

  [[nodiscard]] int steps() const { return step_max - step_min + 1; }
  [[nodiscard]] SimTime period() const { return SimTime{60'000'000'000LL / rpm}; }
  [[nodiscard]] double angle_rad(int step) const;  ///< counter-clockwise, 0 in front
  /// Time from step 0 to a step.
  [[nodiscard]] SimTime step_time(int step) const { return period() * step / steps_per_turn; }
};

enum class ScanPlane : std::uint8_t {
  kLevel,    ///< angle 0 points along the mount's yaw, positive angles to the left
  kCoronal,  ///< in the base's y-z plane: angle 0 points up, positive angles to the left (+y); the floor lies
             ///< behind
};

/// Position of a scanner on base_link; z from the floor.
struct LaserMount {
  double x_m = 0.0, y_m = 0.0, z_m = 0.30;
  double yaw_rad = 0.0;  ///< rotates the plane about the vertical
  ScanPlane plane = ScanPlane::kLevel;
  double roll_rad = 0.0;  ///< coronal: turn of angle 0 from straight up, to the left
  bool mirrored = false;  ///< angles count the other way: mounted upside down, or looking backward
};

/// One turn of the mirror, as measured by the sensor.
struct Sweep {
  SimTime step0{0};                     ///< time of step 0, which is the stamp of SCIP (PROTOCOLS section 12)
  SimTime end{0};                       ///< time of the last step
  std::uint64_t number = 0;             ///< turns since the sensor's start
  int step_min = 0;                     ///< step of element 0
  std::vector<std::uint32_t> range_mm;  ///< or one of the model's codes, below DMIN or beyond DMAX
  std::vector<std::uint16_t> intensity;  ///< 0 where nothing was received
};

/// Measures sweeps: every beam at its own time from the pose at that time. Not thread-safe (buffers are
/// reused).
class LaserSimulator {
 public:
  using PoseAt = std::function<Se2(SimTime)>;
  LaserSimulator(const World& world, LaserModel model, LaserMount mount, const Difficulty& difficulty,
                 std::uint64_t seed, MovableId self = kNoMovable);

  /// The sweep whose step 0 is at time `step0`. Noise depends only on seed and `number`, not on earlier
  /// calls.
  void measure(SimTime step0, std::uint64_t number, const PoseAt& pose_at, Sweep& out);
  [[nodiscard]] Sweep measure(SimTime step0, std::uint64_t number, const PoseAt& pose_at);

  [[nodiscard]] const LaserModel& model() const { return model_; }
  [[nodiscard]] const LaserMount& mount() const { return mount_; }

 private:
  void cast_all(SimTime step0, const PoseAt& pose_at, Random& random);
  void mix_pixels(Random& random);
  [[nodiscard]] std::uint32_t reading(double true_range_m, Random& random) const;
  [[nodiscard]] Ray beam(int step, const Se2& pose) const;

  const World& world_;
  LaserModel model_;
  LaserMount mount_;
  Difficulty difficulty_;
  std::uint64_t seed_;
  MovableId self_;
  std::vector<RayHit> hits_;
  std::vector<double> ranges_m_;
};

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/perception/moving_obstacle.hpp"
#include "core/perception/params.hpp"
#include "core/perception/seen_ground.hpp"
#include "core/perception/stop_zone.hpp"
#include "core/types/base_state.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::perception {

/// Points beside the robot that the front scanner saw and no longer sees. The scanner covers 270 degrees; the
/// tail of a robot that turns on the spot or backs off sweeps through the rest. A point is kept in odom from
/// the time it leaves the scanner's view until something is measured in its direction again, the robot has
/// moved away from it, or BlindSpotParams::kept has passed. Moving obstacles are not kept, because their
/// current positions are unknown. Fixed size, allocates nothing.
class BlindSpot {
 public:
  /// Size of the array; the oldest point makes room when it is full.
  static constexpr std::size_t kMax = 192;

  explicit BlindSpot(const BlindSpotParams& params = {}) : params_(params) {}

  /// Processes every scan once. `points` are scan_points() of the scan, `moving` the moving obstacles, both
  /// in base at its first beam. Points within `outline` belong to the robot itself. A reset of the odometry
  /// clears everything.
  void update(const types::Scan& scan, const types::Se2& T_base_laser, std::span<const ScanPoint> points,
              std::span<const MovingObstacle> moving, const types::Footprint& outline,
              const types::Odometry& odometry);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Writes all kept points, in base at `T_odom_base`; none is marked as forward. `out` has the size size().
  void put_points(const types::Se2& T_odom_base, std::span<ScanPoint> out) const;
  /// Distance that the outline can move straight back from T_odom_base over ground that the scanner observed
  /// within BlindSpotParams::kept, at most `far_m`. Obstacles that it saw there are among the points.
  [[nodiscard]] double seen_behind_m(const types::Se2& T_odom_base, const types::Footprint& outline,
                                     types::Stamp now, double far_m) const {
    return ground_.behind_m(T_odom_base, outline, now - params_.kept, far_m);
  }

 private:
  struct Seen {
    types::Vector2 p_odom{0.0, 0.0};
    types::Stamp last{};  ///< by arrival, as for staleness
  };
  /// Drops points that the new scan measures again, and points that are far away or old.
  void forget(const types::Scan& scan, const types::Se2& T_odom_laser);
  void keep(const types::Vector2& p_odom, types::Stamp seen);

  BlindSpotParams params_;
  std::array<Seen, kMax> seen_{};  ///< in the order in which they were added
  std::size_t size_ = 0;
  SeenGround ground_;
  types::Stamp scan_{};
  types::Se2 T_odom_base_;
};

}  // namespace topo::perception

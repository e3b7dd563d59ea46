// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/perception/moving_obstacle.hpp"
#include "core/perception/seen_ground.hpp"
#include "core/perception/stop_zone.hpp"
#include "core/types/base_state.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::perception {

/// What the front scanner saw beside the robot and sees no longer. It looks over 270 degrees; the tail of a
/// robot that turns on the spot or backs off sweeps through the rest. A point is kept in odom from when it
/// leaves the scanner's view until something is measured in its direction again, the robot is gone from it,
/// or a minute is over. What moves is not kept: where it is now, nobody knows. Fixed size, allocates nothing.
class BlindSpot {
 public:
  static constexpr std::size_t kMax = 192;
  static constexpr types::Duration kKept = std::chrono::seconds(60);

  /// Takes every scan once. `points` are scan_points() of it, `moving` what moves, both in base at its first
  /// beam; what is within `outline` is the robot itself. A reckoning that began anew forgets everything.
  void update(const types::Scan& scan, const types::Se2& T_base_laser, std::span<const ScanPoint> points,
              std::span<const MovingObstacle> moving, const types::Footprint& outline,
              const types::Odometry& odometry);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// All that is kept, in base at `T_odom_base`; none of it is of the forward sector. `out` is size() long.
  void put_points(const types::Se2& T_odom_base, std::span<ScanPoint> out) const;
  /// How far the outline may go straight back from T_odom_base before it gets where the scanner has not
  /// looked lately, at most `far_m`. What it saw there is among the points.
  [[nodiscard]] double seen_behind_m(const types::Se2& T_odom_base, const types::Footprint& outline,
                                     types::Stamp now, double far_m) const {
    return ground_.behind_m(T_odom_base, outline, now - kKept, far_m);
  }

 private:
  struct Seen {
    types::Vector2 p_odom{0.0, 0.0};
    types::Stamp last{};  ///< by arrival, as staleness is judged
  };
  /// What the new scan tells better, and what is far off or old.
  void forget(const types::Scan& scan, const types::Se2& T_odom_laser);
  void keep(const types::Vector2& p_odom, types::Stamp seen);

  std::array<Seen, kMax> seen_{};  ///< what came last is last
  std::size_t size_ = 0;
  SeenGround ground_;
  types::Stamp scan_{};
  types::Se2 T_odom_base_;
};

}  // namespace topo::perception

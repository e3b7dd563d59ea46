// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/motion/params.hpp"
#include "core/types/se2.hpp"
#include "core/types/transform.hpp"

namespace topo::motion {

/// The last metre that the robot drove forwards, in odom or in the frame of the given poses
/// (steady_frame.hpp): the only path back that is known to be free (DESIGN "Motion and safety": the rear is
/// blind). Fixed size.
class BreadcrumbPath {
 public:
  explicit BreadcrumbPath(const BreadcrumbParams& params = {}) : params_(params) {}
  [[nodiscard]] const BreadcrumbParams& params() const { return params_; }

  /// Takes the newest pose. Forward motion extends the path, reverse motion consumes it. A jump (the base's
  /// odometry was reset) clears it.
  void update(const types::Se2& T_odom_base);
  void clear() { size_ = 0; }

  /// Length of the path from the newest pose back to its end, metres.
  [[nodiscard]] double length_m() const;

  /// Distance for which the path lies behind the robot at its current heading, metres: to its end, or to
  /// where the robot turned on the spot.
  [[nodiscard]] double behind_m() const;

  /// Twist backwards along the path with |v| = `speed_mps`; zero when no path is left, or when it does not
  /// lie straight behind (within BreadcrumbParams::behind_rad and off_m).
  [[nodiscard]] types::Twist2 back_twist(double speed_mps) const;
  /// Angle by which the robot must turn so that the path lies straight behind, radians; 0 without a path.
  [[nodiscard]] double turn_to_back_rad() const;

 private:
  /// Size of the array: length_m with points spacing_m apart. Nearer points make the path shorter.
  static constexpr std::size_t kCapacity = 52;
  /// The newest point of the path at that distance or farther; the path's end when there is none.
  [[nodiscard]] types::Vector2 point_base(double away_m) const;
  [[nodiscard]] types::Vector2 target_base() const;
  void push(const types::Vector2& p);
  void drop_oldest();

  BreadcrumbParams params_;
  std::array<types::Vector2, kCapacity> points_{};  ///< oldest first
  std::size_t size_ = 0;
  types::Se2 pose_;
};

}  // namespace topo::motion

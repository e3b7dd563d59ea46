// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/types/se2.hpp"
#include "core/types/transform.hpp"

namespace topo::motion {

/// The last metre of the way that the robot drove forwards, in odom or whatever frame the poses are in
/// (steady_frame.hpp): the only way back that it knows to be free (DESIGN "Motion and safety": the rear is
/// blind). Fixed size.
class BreadcrumbPath {
 public:
  static constexpr double kSpacing_m = 0.02;
  static constexpr double kLength_m = 1.0;
  static constexpr double kBehind_rad = 0.35;  ///< farther aside than this the trail is not behind the robot

  /// The newest pose. Forwards the trail grows, backwards it is used up; a jump of more than a quarter of a
  /// metre (the base's reckoning began anew) ends it.
  void update(const types::Se2& T_odom_base);
  void clear() { size_ = 0; }

  /// Way back from the newest pose to the trail's end, metres.
  [[nodiscard]] double length_m() const;

  /// How far back it lies behind the robot as it stands, metres: to its end, or to where the robot turned on
  /// the spot.
  [[nodiscard]] double behind_m() const;

  /// Backwards along the trail with |v| = `speed_mps`; zero when there is no trail left, or when it does not
  /// lie straight behind (within kBehind_rad and 0.1 m).
  [[nodiscard]] types::Twist2 back_twist(double speed_mps) const;
  /// How far the robot has to turn so that the trail lies straight behind, radians; 0 without a trail.
  [[nodiscard]] double turn_to_back_rad() const;

 private:
  static constexpr std::size_t kCapacity = static_cast<std::size_t>(kLength_m / kSpacing_m) + 2;
  /// The newest point of the trail that is so far away; its end when none is.
  [[nodiscard]] types::Vector2 point_base(double away_m) const;
  [[nodiscard]] types::Vector2 target_base() const;
  void push(const types::Vector2& p);
  void drop_oldest();

  std::array<types::Vector2, kCapacity> points_{};  ///< oldest first
  std::size_t size_ = 0;
  types::Se2 pose_;
};

}  // namespace topo::motion

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/types/robot_limits.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::perception {

/// When beams last went through or the robot last stood where its blind rear may get. Cells of a square that
/// goes along with the robot, in odom. Fixed size, allocates nothing.
class SeenGround {
 public:
  void clear() { cells_.fill({}); }
  /// Takes a scan that was measured at T_odom_base.
  void update(const types::Scan& scan, const types::Se2& T_base_laser, const types::Se2& T_odom_base,
              const types::Footprint& outline);
  /// How far the outline may go straight back over ground only that was seen `since` then, at most `far_m`.
  [[nodiscard]] double behind_m(const types::Se2& T_odom_base, const types::Footprint& outline,
                                types::Stamp since, double far_m) const;

 private:
  static constexpr double kCell_m = 0.04;
  static constexpr std::uint32_t kSide = 64;  ///< a power of two, or the square has a seam
  struct Cell {
    std::int32_t x = 0, y = 0;  ///< of all the plane's cells the one that it stands for
    types::Stamp seen{};        ///< by arrival; zero: never
  };
  static std::size_t slot(std::int32_t x, std::int32_t y);
  void see(const types::Vector2& p_odom, types::Stamp now);
  [[nodiscard]] bool is_seen(const types::Vector2& p_odom, types::Stamp since) const;

  std::array<Cell, std::size_t{kSide} * kSide> cells_{};
};

}  // namespace topo::perception

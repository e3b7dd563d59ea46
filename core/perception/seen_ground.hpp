// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/perception/params.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::perception {

/// When a beam last passed over, or the robot last stood on, the ground that its blind rear may reach. The
/// cells form a square in odom that moves with the robot. Fixed size, allocates nothing.
class SeenGround {
 public:
  void clear() { cells_.fill({}); }
  /// Processes a scan that was measured at T_odom_base.
  void update(const types::Scan& scan, const types::Se2& T_base_laser, const types::Se2& T_odom_base,
              const types::Footprint& outline, const SeenGroundParams& params);
  /// Distance that the outline can move straight back only over ground seen at `since` or later, at most
  /// `far_m`.
  [[nodiscard]] double behind_m(const types::Se2& T_odom_base, const types::Footprint& outline,
                                types::Stamp since, double far_m) const;

 private:
  static constexpr double kCell_m = 0.04;     ///< with kSide: a square of 2.6 m, 64 KiB
  static constexpr std::uint32_t kSide = 64;  ///< a power of two; otherwise the square has a seam
  struct Cell {
    std::int32_t x = 0, y = 0;  ///< the cell of the plane that it stands for
    types::Stamp seen{};        ///< arrival of the scan; zero: never
  };
  static std::size_t slot(std::int32_t x, std::int32_t y);
  void see(const types::Vector2& p_odom, types::Stamp now);
  [[nodiscard]] bool is_seen(const types::Vector2& p_odom, types::Stamp since) const;

  std::array<Cell, std::size_t{kSide} * kSide> cells_{};
};

}  // namespace topo::perception

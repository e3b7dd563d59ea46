// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/types/se2.hpp"

namespace topo::types {

/// Directions from `from_rad` counter-clockwise to `to_rad`, both inclusive; to_rad is not below from_rad,
/// and less than a turn above.
struct Sector {
  double from_rad = 0.0, to_rad = 0.0;
  static constexpr double kRounding_rad = 1e-6;  ///< angles of beams are of single precision
  [[nodiscard]] double width_rad() const { return to_rad - from_rad; }
  [[nodiscard]] bool holds(double angle_rad) const {
    const double middle_rad = 0.5 * (from_rad + to_rad);
    return std::abs(wrap_angle(angle_rad - middle_rad)) <= 0.5 * width_rad() + kRounding_rad;
  }
  friend bool operator==(const Sector&, const Sector&) = default;
};

/// A few sectors, without allocation.
struct Sectors {
  static constexpr std::size_t kMost = 8;
  std::array<Sector, kMost> all{};
  std::size_t count = 0;
  [[nodiscard]] bool holds(double angle_rad) const {
    for (std::size_t i = 0; i < count; ++i)
      if (all[i].holds(angle_rad)) return true;
    return false;
  }
  friend bool operator==(const Sectors&, const Sectors&) = default;
};

}  // namespace topo::types

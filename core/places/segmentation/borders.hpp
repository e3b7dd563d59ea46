// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/places/segmentation/regions.hpp"

namespace topo::places {

/// Sums over the borders between regions.
class Borders {
 public:
  /// The sums for two regions.
  struct Between {
    std::uint32_t other = 0;  ///< the region with the higher number
    std::uint32_t upright = 0, level = 0;
    std::uint32_t wall_steps = 0;
    float clearance_m = 0.0F;
    std::uint32_t next = 0;  ///< next entry of the region with the lower number
  };

  explicit Borders(std::size_t regions) : newest_(regions, kNone), count_(regions, 0) {}

  /// Valid until the next call.
  Between& between(std::uint32_t a, std::uint32_t b);
  /// Replaces the contacts of both sides of each border, in the order of the other regions' numbers.
  /// `wall_step_m`: WallSideParams::step_m.
  void hand_out(std::vector<Region>& regions, double wall_step_m) const;

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<Between> all_;
  std::vector<std::uint32_t> newest_;  ///< newest entry of each region, as the one with the lower number
  std::vector<std::uint32_t> count_;   ///< number of borders of each region
};

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/places/segmentation/regions.hpp"

namespace topo::places {

/// What lies between regions, summed up as it is found.
class Borders {
 public:
  /// That between two regions.
  struct Between {
    std::uint32_t other = 0;  ///< the one with the higher number
    std::uint32_t upright = 0, level = 0;
    std::uint32_t wall_steps = 0;
    float clearance_m = 0.0F;
    std::uint32_t next = 0;  ///< of those of the region with the lower number
  };

  explicit Borders(std::size_t regions) : newest_(regions, kNone), count_(regions, 0) {}

  /// Good until the next call.
  Between& between(std::uint32_t a, std::uint32_t b);
  /// To both sides, whose contacts are gone before, in the order of the others' numbers.
  void hand_out(std::vector<Region>& regions) const;

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<Between> all_;
  std::vector<std::uint32_t> newest_;  ///< of each region among those in which it has the lower number
  std::vector<std::uint32_t> count_;   ///< of each region
};

}  // namespace topo::places

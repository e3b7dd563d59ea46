// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/first_labels.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

/// The labels on both sides of so much wall; the same on both at an opening.
struct WallBetween {
  std::uint32_t a = 0, b = 0;
  std::uint32_t steps = 0;
  friend bool operator==(const WallBetween&, const WallBetween&) = default;
};

/// Length of wall of so many steps: as they add up, one after the other, so that it is the same to the bit
/// whoever counted them.
float wall_length_m(std::uint32_t steps);

/// What walls have on both sides, a step after the other along them. Walls in any direction. A value.
class WallSides {
 public:
  /// `change`: from the labels taken last; nothing: they say nothing of these. A wall that was there then and
  /// near which nothing has changed is not looked at again.
  void take(const grid::DenseMap& map, std::span<const std::uint32_t> labels,
            std::span<const types::Segment> walls, const std::optional<LabelChange>& change);

  /// Wall by wall; two labels may be listed repeatedly.
  [[nodiscard]] const std::vector<WallBetween>& all() const { return all_; }

 private:
  struct Wall {
    types::Segment segment;
    std::size_t first = 0, count = 0;  ///< of `all_`
  };
  std::vector<Wall> walls_;  ///< by their ends
  std::vector<WallBetween> all_;
};

}  // namespace topo::places

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

/// The labels on both sides of a stretch of wall; equal at an opening.
struct WallBetween {
  std::uint32_t a = 0, b = 0;
  std::uint32_t steps = 0;
  friend bool operator==(const WallBetween&, const WallBetween&) = default;
};

/// Length of a wall of this number of steps, added one by one, so that it is bit-identical however the steps
/// were counted.
float wall_length_m(std::uint32_t steps);

/// The labels on both sides of walls, step by step along them. Walls may have any direction. A value.
class WallSides {
 public:
  /// `change`: from the labels taken last; nothing: those labels are unrelated to these. A wall that was
  /// present then, and near which nothing has changed, is not examined again.
  void take(const grid::DenseMap& map, std::span<const std::uint32_t> labels,
            std::span<const types::Segment> walls, const std::optional<LabelChange>& change);

  /// In the order of the walls; a pair of labels may occur repeatedly.
  [[nodiscard]] const std::vector<WallBetween>& all() const { return all_; }

 private:
  struct Wall {
    types::Segment segment;
    std::size_t first = 0, count = 0;  ///< of `all_`
  };
  std::vector<Wall> walls_;  ///< sorted by their ends
  std::vector<WallBetween> all_;
};

}  // namespace topo::places

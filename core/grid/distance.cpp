// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/distance.hpp"

#include "core/grid/distance_passes.hpp"

namespace topo::grid {
namespace {

/// Writes the distances along the columns to `steps`: from below first, then from above.
void column_pass(const DenseMap& map, bool open_outside, std::vector<Steps>& steps) {
  const auto width = static_cast<std::size_t>(map.width()), height = static_cast<std::size_t>(map.height());
  const std::vector<Steps> outside(width, open_outside ? kNone : Steps{0});
  const auto up = open_outside ? steps_on<Boundary::kOccupied> : steps_on<Boundary::kOccupiedOrUnknown>;
  steps.resize(map.cells.size());
  for (std::size_t y = 0; y < height; ++y) {
    const Steps* below = y == 0 ? outside.data() : &steps[(y - 1) * width];
    up(&map.cells[y * width], below, &steps[y * width], width);
  }
  for (std::size_t y = height; y-- > 0;) {
    const Steps* above = y + 1 == height ? outside.data() : &steps[(y + 1) * width];
    steps_back(above, &steps[y * width], width);
  }
}

}  // namespace

std::vector<float> clearance_m(const DenseMap& map, Boundary boundary) {
  std::vector<float> clearance(map.cells.size(), 0.0F);
  if (clearance.empty()) return clearance;
  const bool open_outside = boundary == Boundary::kOccupied;
  const auto width = static_cast<std::size_t>(map.width());
  std::vector<Steps> steps;
  column_pass(map, open_outside, steps);
  RowPass pass(width, map.resolution_m, open_outside);
  for (std::size_t at = 0; at < clearance.size(); at += width)
    pass.cells(&steps[at], 0, map.width(), &clearance[at]);
  return clearance;
}

}  // namespace topo::grid

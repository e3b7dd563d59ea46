// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/grid/occupancy_grid.hpp"

namespace topo::grid {

/// Copies a row-major array over `box` to one over the larger box `to`; new cells are T{}.
template <class T>
std::vector<T> over_box(const std::vector<T>& from, const CellBox& box, const CellBox& to) {
  std::vector<T> out(static_cast<std::size_t>(to.width()) * static_cast<std::size_t>(to.height()), T{});
  const std::ptrdiff_t width = static_cast<std::ptrdiff_t>(box.width()),
                       to_width = static_cast<std::ptrdiff_t>(to.width());
  for (std::ptrdiff_t row = 0; row < box.height(); ++row) {
    const std::ptrdiff_t to_row = row + box.min.y - to.min.y;
    std::copy_n(from.begin() + row * width, width, out.begin() + to_row * to_width + box.min.x - to.min.x);
  }
  return out;
}

}  // namespace topo::grid

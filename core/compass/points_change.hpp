// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/types/geometry.hpp"

namespace topo::compass {

/// Row by row, as the cells of a map.
inline bool comes_before(const types::Vector2& a, const types::Vector2& b) {
  return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
}

/// Points and their difference from the previous points.
struct PointsChange {
  std::span<const types::Vector2> now;
  std::vector<types::Vector2> come, gone;
};

/// One pass over both when they are row by row; for other orders the difference is larger than necessary.
PointsChange points_change(std::span<const types::Vector2> before, std::span<const types::Vector2> now);

}  // namespace topo::compass

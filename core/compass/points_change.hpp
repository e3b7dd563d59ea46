// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/types/geometry.hpp"

namespace topo::compass {

/// Row by row, as cells go over a map.
inline bool comes_before(const types::Vector2& a, const types::Vector2& b) {
  return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
}

/// Points, and how they differ from those before.
struct PointsChange {
  std::span<const types::Vector2> now;
  std::vector<types::Vector2> come, gone;
};

/// Costs a pass over both when they go row by row; of points in other orders more come and go than need be.
PointsChange points_change(std::span<const types::Vector2> before, std::span<const types::Vector2> now);

}  // namespace topo::compass

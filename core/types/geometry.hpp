// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"

namespace topo::types {

/// Axis-aligned rectangle; empty while min > max.
struct Rectangle {
  Vector2 min{HUGE_VAL, HUGE_VAL};
  Vector2 max{-HUGE_VAL, -HUGE_VAL};

  [[nodiscard]] bool empty() const { return min.x() > max.x() || min.y() > max.y(); }
  void extend(const Vector2& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  [[nodiscard]] bool contains(const Vector2& p) const {
    return p.x() >= min.x() && p.x() <= max.x() && p.y() >= min.y() && p.y() <= max.y();
  }
};

struct Segment {
  Vector2 a{0.0, 0.0};
  Vector2 b{0.0, 0.0};
  [[nodiscard]] double length_m() const { return (b - a).norm(); }
};

}  // namespace topo::types

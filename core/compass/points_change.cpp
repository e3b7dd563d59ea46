// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/points_change.hpp"

namespace topo::compass {

PointsChange points_change(std::span<const types::Vector2> before, std::span<const types::Vector2> now) {
  PointsChange change{now, {}, {}};
  auto old = before.begin();
  for (const types::Vector2& p : now) {
    while (old != before.end() && comes_before(*old, p)) change.gone.push_back(*old++);
    if (old != before.end() && *old == p)
      ++old;
    else
      change.come.push_back(p);
  }
  change.gone.insert(change.gone.end(), old, before.end());
  return change;
}

}  // namespace topo::compass

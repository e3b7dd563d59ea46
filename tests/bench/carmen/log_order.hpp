// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

namespace topo::bench {

/// Sorts by stamp, stable; returns the number of items with a stamp before that of the previous item.
template <class Stamped>
int sort_by_stamp(std::vector<Stamped>& items) {
  const auto earlier = [](const Stamped& a, const Stamped& b) { return a.stamp_s < b.stamp_s; };
  int inversions = 0;
  for (std::size_t i = 1; i < items.size(); ++i) inversions += earlier(items[i], items[i - 1]) ? 1 : 0;
  if (inversions > 0) std::stable_sort(items.begin(), items.end(), earlier);
  return inversions;
}

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace topo::places {

/// Number of cells by which to prefetch.
inline constexpr std::size_t kFetchAhead = 12;

/// During work on cell `k` of a list, prefetches the value of a later cell. Cells along the axis, or in
/// ascending order of clearance, are scattered over the map, and waiting for memory takes longer than the
/// work on them.
template <class T>
void fetch_ahead(const T* values, std::span<const std::uint32_t> cells, std::size_t k) {
  if (k + kFetchAhead < cells.size()) __builtin_prefetch(values + cells[k + kFetchAhead]);
}

}  // namespace topo::places

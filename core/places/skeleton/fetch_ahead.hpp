// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace topo::places {

/// So many cells before their turn.
inline constexpr std::size_t kFetchAhead = 12;

/// While cell `k` of a list is looked at, fetches what a map has for one that comes soon: cells along the
/// axis, and those in rising order of clearance, lie all over the map, and waiting for memory takes longer
/// than what is done with them.
template <class T>
void fetch_ahead(const T* values, std::span<const std::uint32_t> cells, std::size_t k) {
  if (k + kFetchAhead < cells.size()) __builtin_prefetch(values + cells[k + kFetchAhead]);
}

}  // namespace topo::places

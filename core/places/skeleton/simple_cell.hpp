// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace topo::places {

namespace detail {

/// For each pattern of neighbours: true when Yokoi's connectivity number is one.
inline constexpr std::array<bool, 256> kSimple = [] {
  std::array<bool, 256> table{};
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    const auto open = [&](unsigned k) { return (pattern >> (k & 7U) & 1U) == 0; };
    int number = 0;
    for (unsigned k = 0; k < 8; k += 2) {
      if (open(k) && !(open(k + 1) && open(k + 2))) ++number;
    }
    table[pattern] = number == 1;
  }
  return table;
}();

}  // namespace detail

/// True when removing a free cell changes neither components nor holes. Bit k of the pattern: neighbour k,
/// counter-clockwise from east, is free.
constexpr bool is_simple(unsigned pattern) { return detail::kSimple[pattern]; }

}  // namespace topo::places

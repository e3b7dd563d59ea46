// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace topo::places {

/// Calls f(index) for what has one of the bits, in rising order; most have none.
template <class T, class F>
void for_each_with(T bits, std::span<const T> values, F&& f) {
  constexpr std::size_t kAtOnce = sizeof(std::uint64_t) / sizeof(T);
  std::array<T, kAtOnce> masks{};
  masks.fill(bits);
  const auto mask = std::bit_cast<std::uint64_t>(masks);
  std::size_t i = 0;
  const auto visit = [&](std::size_t end) {
    for (; i < end; ++i)
      if ((values[i] & bits) != 0) f(i);
  };
  for (std::uint64_t several = 0; i + kAtOnce <= values.size();) {
    std::memcpy(&several, &values[i], sizeof several);
    if ((several & mask) == 0)
      i += kAtOnce;
    else
      visit(i + kAtOnce);
  }
  visit(values.size());
}

}  // namespace topo::places

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

/// Calls f(index) for values with one of the bits, ascending. Fast when most values have none.
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
  constexpr std::size_t kWords = 4;
  for (std::array<std::uint64_t, kWords> words{}; i + kWords * kAtOnce <= values.size();) {
    std::memcpy(words.data(), &values[i], sizeof words);
    if (((words[0] | words[1] | words[2] | words[3]) & mask) == 0) {
      i += kWords * kAtOnce;
      continue;
    }
    for (const std::uint64_t several : words) {
      if ((several & mask) == 0)
        i += kAtOnce;
      else
        visit(i + kAtOnce);
    }
  }
  visit(values.size());
}

}  // namespace topo::places

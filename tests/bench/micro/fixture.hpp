// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "core/patricia/map.hpp"

namespace topo::bench {

using patricia::Cell;
using patricia::cell_key;
using patricia::Key;
using Bits = std::uint32_t;
using BitArena = patricia::Arena<Bits>;
using BitMap = patricia::Map<Bits>;

inline constexpr auto kUnion = [](const Bits& a, const Bits& b) { return a | b; };

/// What a map of n keys costs to copy at least: key and value, without any structure.
inline constexpr std::size_t kPackedBytes = 12;

/// A square of n cells, all of them: the densest case, so the longest way down for its extent.
inline std::int32_t square_side(std::int64_t n) {
  return static_cast<std::int32_t>(std::lround(std::ceil(std::sqrt(static_cast<double>(n)))));
}
inline std::vector<Key> square_keys(std::int64_t n) {
  const std::int32_t side = square_side(n);
  std::vector<Key> keys;
  keys.reserve(static_cast<std::size_t>(n));
  for (std::int32_t y = 0; y < side; ++y) {
    for (std::int32_t x = 0; x < side && keys.size() < static_cast<std::size_t>(n); ++x) {
      keys.push_back(cell_key(x - side / 2, y - side / 2));
    }
  }
  return keys;
}
inline std::vector<Key> shuffled(std::vector<Key> keys) {
  std::mt19937_64 random(1);
  std::shuffle(keys.begin(), keys.end(), random);
  return keys;
}

/// About a thousand cells near each other, as one keyframe's columns are: the outline of a room, 4 deep,
/// whose corner moves with `step` over the square.
inline std::vector<Key> room_keys(std::int64_t n, std::int64_t step) {
  const std::int32_t side = square_side(n);
  const std::int32_t room = std::min<std::int32_t>(64, side);
  const auto range = std::max<std::int32_t>(side - room, 1);
  const std::int32_t x0 = static_cast<std::int32_t>((step * 7919) % range) - side / 2;
  const std::int32_t y0 = static_cast<std::int32_t>((step * 104729) % range) - side / 2;
  std::vector<Key> keys;
  for (std::int32_t y = 0; y < room; ++y) {
    for (std::int32_t x = 0; x < room; ++x) {
      const std::int32_t edge = std::min(std::min(x, room - 1 - x), std::min(y, room - 1 - y));
      if (edge < 4) keys.push_back(cell_key(x0 + x, y0 + y));
    }
  }
  return keys;
}

inline BitMap make_square(BitArena& arena, std::int64_t n) {
  BitMap map(arena);
  for (const Key key : square_keys(n)) map.insert(key, 1);
  return map;
}

/// Seconds that copying `bytes` takes here and now, best of three: the floor of whatever copies as much.
inline double memcpy_seconds(std::size_t bytes) {
  std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes, 2);
  double best = HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    const auto start = std::chrono::steady_clock::now();
    std::memcpy(to.data(), from.data(), bytes);
    const auto end = std::chrono::steady_clock::now();
    const volatile char used = to[bytes / 2];
    (void)used;
    best = std::min(best, std::chrono::duration<double>(end - start).count());
  }
  return best;
}

}  // namespace topo::bench

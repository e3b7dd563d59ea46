// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace topo::patricia {

/// Key of a cell in a tree: the bits of x and y interleaved (Morton order), x in the even bits, both offset
/// so that negative coordinates sort before positive ones. Keys with common upper bits form a square block of
/// cells (or two squares side by side), so a subtree is a block and a window query prunes whole subtrees.
using Key = std::uint64_t;

struct Cell {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Rectangle of cells, both corners inclusive; empty when min > max in x or y.
struct CellWindow {
  Cell min;
  Cell max;
  [[nodiscard]] constexpr bool contains(Cell c) const {
    return c.x >= min.x && c.x <= max.x && c.y >= min.y && c.y <= max.y;
  }
  [[nodiscard]] constexpr bool empty() const { return min.x > max.x || min.y > max.y; }
};

/// Bit masks of x and of y in a key. Interleaving preserves order: two keys under one mask compare as their
/// coordinates do, without decoding.
inline constexpr Key kKeyBitsX = 0x5555555555555555U;
inline constexpr Key kKeyBitsY = kKeyBitsX << 1U;

namespace detail {

// Five shift-and-mask steps put a zero between neighbouring bits: without a table or a BMI2 instruction, the
// code is the same on every machine.
constexpr std::uint64_t spread_bits(std::uint32_t value) {
  std::uint64_t v = value;
  v = (v | (v << 16U)) & 0x0000FFFF0000FFFFU;
  v = (v | (v << 8U)) & 0x00FF00FF00FF00FFU;
  v = (v | (v << 4U)) & 0x0F0F0F0F0F0F0F0FU;
  v = (v | (v << 2U)) & 0x3333333333333333U;
  v = (v | (v << 1U)) & 0x5555555555555555U;
  return v;
}

constexpr std::uint32_t gather_bits(std::uint64_t v) {
  v &= 0x5555555555555555U;
  v = (v | (v >> 1U)) & 0x3333333333333333U;
  v = (v | (v >> 2U)) & 0x0F0F0F0F0F0F0F0FU;
  v = (v | (v >> 4U)) & 0x00FF00FF00FF00FFU;
  v = (v | (v >> 8U)) & 0x0000FFFF0000FFFFU;
  v = (v | (v >> 16U)) & 0x00000000FFFFFFFFU;
  return static_cast<std::uint32_t>(v);
}

// Flipping the sign bit maps the signed order onto the unsigned one.
inline constexpr std::uint32_t kSignBit = 0x80000000U;

}  // namespace detail

constexpr Key cell_key(std::int32_t x, std::int32_t y) {
  return detail::spread_bits(static_cast<std::uint32_t>(x) ^ detail::kSignBit) |
         (detail::spread_bits(static_cast<std::uint32_t>(y) ^ detail::kSignBit) << 1U);
}
constexpr Key cell_key(Cell c) { return cell_key(c.x, c.y); }

constexpr Cell cell_of(Key key) {
  return {static_cast<std::int32_t>(detail::gather_bits(key) ^ detail::kSignBit),
          static_cast<std::int32_t>(detail::gather_bits(key >> 1U) ^ detail::kSignBit)};
}

}  // namespace topo::patricia

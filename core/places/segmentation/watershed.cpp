// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/watershed.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace topo::places {
namespace {

/// Eight neighbours in one word, one byte each, to test all at once.
using Eight = std::uint64_t;
constexpr Eight kOnes = 0x0101010101010101U;
constexpr Eight kHighs = kOnes << 7U;

/// Sets the highest bit of each byte that is zero; all bytes must be below 128.
constexpr Eight zeros(Eight bytes) { return ~(bytes + kOnes * 127) & kHighs; }

/// Neighbours in the order of memory, from south-west to north-east.
constexpr std::array<std::uint8_t, 8> kNumbers = {5, 6, 7, 4, 0, 3, 2, 1};  ///< as in neighbour_offsets

constexpr Eight word_of(auto byte_of) {
  Eight word = 0;
  for (unsigned b = 0; b < 8; ++b) word |= Eight{byte_of(kNumbers[b])} << (8 * b);
  return word;
}
constexpr Eight kOwn = word_of([](unsigned number) { return number; });
/// Numbers of slopes that lead from the neighbours to this cell.
constexpr Eight kBack = word_of([](unsigned number) { return (number + 4) % 8; });

class Search {
 public:
  Search(const grid::DenseMap& map, std::vector<Slope>& slopes)
      : slopes_(slopes.data()), width_(map.width()), found_(slopes.size()) {
    for (unsigned b = 0; b < 3; ++b) {
      offsets_[b] = static_cast<std::ptrdiff_t>(b) - 1 - width_;
      offsets_[b + 5] = static_cast<std::ptrdiff_t>(b) - 1 + width_;
    }
    offsets_[3] = -1;
    offsets_[4] = 1;
  }

  /// The search continues from here to all neighbours of these cells, whether linked to them or not.
  void begin_at(std::span<const std::uint32_t> cells) {
    for (const std::uint32_t i : cells)
      if (is_open(slopes_[i])) mark(i);
    for (const std::uint32_t i : cells) visit_those(i, kHighs & open(around(i)));
  }
  void run() {
    while (!queue_.empty()) {
      const std::uint32_t i = queue_.back();
      queue_.pop_back();
      const Eight all = around(i), numbers = all & kOnes * kNumber;
      const Eight up = kOnes * (slopes_[i] & kNumber);
      const Eight linked = zeros(up ^ kOnes * kFlat) | zeros(up ^ kOwn) | zeros(numbers ^ kOnes * kFlat) |
                           zeros(numbers ^ kBack);
      visit_those(i, linked & open(all));
    }
  }
  [[nodiscard]] grid::CellBlocks found() && { return std::move(found_); }

 private:
  static constexpr Slope kNever = kOnAxis | kVisited | kClosed;
  static bool is_open(Slope slope) { return (slope & kNever) == 0; }
  static Eight open(Eight slopes) { return zeros(slopes & kOnes * kNever); }

  [[nodiscard]] Eight around(std::uint32_t i) const {
    static_assert(std::endian::native == std::endian::little);
    const Slope* const at = slopes_ + i;
    std::uint32_t low = 0, high = 0;  // four bytes each, one more than the three of the row
    std::memcpy(&low, at - width_ - 1, sizeof low);
    std::memcpy(&high, at + width_ - 2, sizeof high);
    return Eight{low & 0xFFFFFFU} | Eight{at[-1]} << 24U | Eight{at[1]} << 32U | Eight{high >> 8U} << 40U;
  }
  /// Visits the neighbours whose highest bit is set.
  void visit_those(std::uint32_t i, Eight which) {
    for (; which != 0; which &= which - 1) {
      const auto b = static_cast<std::size_t>(std::countr_zero(which)) / 8;
      visit(static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[b]));
    }
  }
  void visit(std::uint32_t i) {
    mark(i);
    queue_.push_back(i);
  }
  void mark(std::uint32_t i) {
    slopes_[i] |= kVisited;
    found_.add(i);
  }

  Slope* slopes_;
  std::ptrdiff_t width_;
  std::array<std::ptrdiff_t, 8> offsets_{};
  grid::CellBlocks found_;
  std::vector<std::uint32_t> queue_;
};

}  // namespace

grid::CellBlocks find_basins(const grid::DenseMap& map, std::span<const std::uint32_t> changed,
                             std::vector<Slope>& slopes) {
  Search search(map, slopes);
  search.begin_at(changed);
  search.run();
  return std::move(search).found();
}

}  // namespace topo::places

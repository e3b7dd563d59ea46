// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/first_states.hpp"

#include <array>
#include <cstring>

#include "core/grid/cell_block.hpp"
#include "core/grid/occupancy_grid.hpp"
#include "core/places/skeleton/sparse_scan.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;
using grid::kCellBlock;

/// Initial states: every cell that is not on the ridge is removed at its turn.
class Assumption {
 public:
  Assumption(const DenseMap& map, std::span<const float> clearance_m, std::vector<ThinningState>& states)
      : map_(map),
        width_(static_cast<std::size_t>(map.width())),
        clearance_m_(clearance_m),
        fates_(states),
        buckets_per_m_(buckets_per_m(map)) {}

  /// Handles all rows; returns the cells for which the assumption does not hold, ascending.
  std::vector<std::uint32_t> run() {
    const auto height = static_cast<std::size_t>(map_.height());
    Row low(width_, 0), mid(width_, 0), high(width_, 0);
    for (std::size_t y = 0; y < height; ++y) {
      // Every row is first the upper, then the middle, then the lower one. Row 0 counts as empty, like all of
      // the border.
      low.swap(mid);
      mid.swap(high);
      if (y + 1 < height) fill(y + 1, high);
      if (y > 0 && y + 1 < height) assume_row(y, {low.data(), mid.data(), high.data()});
    }
    return std::move(doubtful_);
  }

 private:
  using Row = std::vector<std::int16_t>;  ///< buckets
  using Marks = std::array<std::uint8_t, kCellBlock>;
  struct Rows {
    const std::int16_t *low, *mid, *high;
  };

  [[nodiscard]] bool has_free(std::size_t first, std::size_t count) const {
    return std::memchr(&map_.cells[first], static_cast<int>(CellState::kFree), count) != nullptr;
  }
  void fill(std::size_t y, Row& row) const {
    const float per_m = buckets_per_m_;
    for (std::size_t x = 0; x < width_; x += kCellBlock) {
      const std::size_t count = std::min(kCellBlock, width_ - x);
      std::int16_t* const to = &row[x];
      const float* const from = &clearance_m_[y * width_ + x];
      if (!has_free(y * width_ + x, count)) {
        std::fill_n(to, count, std::int16_t{0});
        continue;
      }
      for (std::size_t i = 0; i < count; ++i)
        to[i] = static_cast<std::int16_t>(bucket_of(state_of(from[i], per_m)));
    }
  }
  void assume_row(std::size_t y, const Rows& rows) {
    for (std::size_t x = 1; x + 1 < width_; x += kCellBlock) {
      const std::size_t count = std::min(kCellBlock, width_ - 1 - x);
      if (has_free(y * width_ + x, count))
        assume(y * width_ + x, count, {rows.low + x, rows.mid + x, rows.high + x});
    }
  }
  void assume(std::size_t first, std::size_t count, const Rows& rows) {
    Marks ridge, simple;
    find_ridge(first, count, ridge);
    find_simple(rows, count, simple);
    ThinningState* const state = &fates_[first];
    for (std::size_t i = 0; i < count; ++i) {
      const auto bucket = static_cast<unsigned>(rows.mid[i]);
      const auto free = static_cast<ThinningState>(bucket == 0 ? 0 : 0xFFFF);
      state[i] =
          static_cast<ThinningState>((bucket << kBucketShift | ridge[i] * unsigned{Erosion::kRidge}) & free);
    }
    Marks doubtful{};
    for (std::size_t i = 0; i < count; ++i)
      doubtful[i] = static_cast<std::uint8_t>((ridge[i] | (simple[i] ^ 1U)) & (rows.mid[i] != 0 ? 1U : 0U));
    for_each_with<std::uint8_t>(
        1, doubtful, [&](std::size_t i) { doubtful_.push_back(static_cast<std::uint32_t>(first + i)); });
  }
  void find_ridge(std::size_t first, std::size_t count, Marks& ridge) const {
    const auto cell_m = static_cast<float>(map_.resolution_m);
    const float* const mid = &clearance_m_[first];
    const float *const low = mid - width_, *const high = mid + width_;
    std::array<std::int32_t, kCellBlock> is{};
    for (std::size_t i = 0; i < count; ++i) {
      const float side = larger(larger(mid[i - 1], mid[i + 1]), larger(low[i], high[i]));
      const float corner = larger(larger(low[i - 1], low[i + 1]), larger(high[i - 1], high[i + 1]));
      is[i] = is_ridge(mid[i], side, corner, cell_m) ? 1 : 0;
    }
    for (std::size_t i = 0; i < count; ++i) ridge[i] = static_cast<std::uint8_t>(is[i]);
  }
  /// As is_simple, in arithmetic. Of the cells in one bucket, those with a greater number still remain.
  static void find_simple(const Rows& rows, std::size_t count, Marks& simple) {
    const std::int16_t *const low = rows.low, *const mid = rows.mid, *const high = rows.high;
    for (std::size_t i = 0; i < count; ++i) {
      const std::int16_t here = mid[i];
      const bool off_east =
          mid[i + 1]<here, north_east = high[i + 1] >= here,
                     off_north = high[i]<here, north_west = high[i - 1] >= here,
                                         off_west = mid[i - 1] <= here, south_west = low[i - 1]>
                         here,
                     off_south = low[i] <= here, south_east = low[i + 1]>
              here;
      const int number =
          (off_east & (north_east | (off_north ^ 1))) + (off_north & (north_west | (off_west ^ 1))) +
          (off_west & (south_west | (off_south ^ 1))) + (off_south & (south_east | (off_east ^ 1)));
      simple[i] = static_cast<std::uint8_t>(number == 1);
    }
  }

  const DenseMap& map_;
  std::size_t width_;
  std::span<const float> clearance_m_;
  std::vector<ThinningState>& fates_;
  float buckets_per_m_;
  std::vector<std::uint32_t> doubtful_;
};

}  // namespace

std::vector<std::uint32_t> assume_states(const DenseMap& map, std::span<const float> clearance_m,
                                         std::vector<ThinningState>& states) {
  return Assumption(map, clearance_m, states).run();
}

}  // namespace topo::places

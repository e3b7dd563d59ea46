// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/thinning.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

/// Yokoi's connectivity number of a free cell for each pattern of its neighbours (bit k: neighbour k is
/// free); 1: the cell is simple, taking it away changes neither components nor holes.
constexpr bool is_simple(unsigned pattern) {
  const auto open = [&](unsigned k) { return (pattern >> (k & 7U) & 1U) == 0; };
  int number = 0;
  for (unsigned k = 0; k < 8; k += 2) {
    if (open(k) && !(open(k + 1) && open(k + 2))) ++number;
  }
  return number == 1;
}

constexpr std::array<bool, 256> kSimple = [] {
  std::array<bool, 256> table{};
  for (unsigned pattern = 0; pattern < 256; ++pattern) table[pattern] = is_simple(pattern);
  return table;
}();

unsigned pattern_at(const std::uint8_t* marks, const std::array<std::ptrdiff_t, 8>& offsets) {
  unsigned pattern = 0;
  for (unsigned k = 0; k < 8; ++k) pattern |= (marks[offsets[k]] & unsigned{Thinning::kOn}) << k;
  return pattern;
}

/// Marks of one row. On the ridge no neighbour is much clearer: with a wall on one side clearance rises by
/// nearly a cell a cell somewhere (at least 0.92, because neighbours lie in eight directions), on the axis of
/// a right-angled corner by 0.71, in a corridor not at all. Near the boundary, where distances jump, only
/// what is as flat as a corridor counts.
void mark_row(const DenseMap& map, std::span<const float> clearance_m, std::size_t row,
              std::vector<std::uint8_t>& marks) {
  const auto width = static_cast<std::size_t>(map.width());
  const auto cell_m = static_cast<float>(map.resolution_m);
  const float* mid = clearance_m.data() + row * width;
  const float *low = mid - width, *high = mid + width;
  const CellState* state = map.cells.data() + row * width;
  std::uint8_t* mark = marks.data() + row * width;
  for (std::size_t x = 1; x + 1 < width; ++x) {
    const float side = std::max(std::max(mid[x - 1], mid[x + 1]), std::max(low[x], high[x]));
    const float corner = std::max(std::max(low[x - 1], low[x + 1]), std::max(high[x - 1], high[x + 1]));
    const float rise = std::max(side - mid[x], (corner - mid[x]) * 0.70711F);
    const bool ridge = rise < cell_m * (mid[x] < 3.0F * cell_m ? 0.3F : 0.8F);
    mark[x] = state[x] != CellState::kFree ? std::uint8_t{0}
              : ridge                      ? std::uint8_t{Thinning::kOn | Thinning::kRidge}
                                           : Thinning::kOn;
  }
}

/// All marked cells in rising order of clearance.
struct Order {
  std::vector<std::uint32_t> cells;
  std::vector<std::uint32_t> ends;  ///< of each bucket, an eighth of a cell of clearance wide
};

/// Calls f(index) for all marked cells, in order. Most of a map has none.
template <class F>
void for_each_marked(std::span<const std::uint8_t> marks, F&& f) {
  std::size_t i = 0;
  const auto visit = [&](std::size_t end) {
    for (; i < end; ++i)
      if (marks[i] != 0) f(i);
  };
  for (std::uint64_t eight = 0; i + sizeof eight <= marks.size();) {
    std::memcpy(&eight, &marks[i], sizeof eight);
    if (eight == 0)
      i += sizeof eight;
    else
      visit(i + sizeof eight);
  }
  visit(marks.size());
}

Order by_clearance(const DenseMap& map, std::span<const float> clearance_m,
                   std::span<const std::uint8_t> marks) {
  constexpr std::int32_t kBuckets = 8192;  // from 1024 cells of clearance on in any order
  const auto scale = static_cast<float>(8.0 / map.resolution_m);
  struct Placed {
    std::uint32_t cell;
    std::int32_t bucket;
  };
  std::vector<Placed> placed;
  placed.reserve(static_cast<std::size_t>(std::count(map.cells.begin(), map.cells.end(), CellState::kFree)));
  Order order{{}, std::vector<std::uint32_t>(kBuckets + 1, 0)};
  for_each_marked(marks, [&](std::size_t i) {
    const auto bucket =
        static_cast<std::int32_t>(std::min(clearance_m[i] * scale, static_cast<float>(kBuckets - 1)));
    placed.push_back({static_cast<std::uint32_t>(i), bucket});
    ++order.ends[static_cast<std::size_t>(bucket + 1)];
  });
  for (std::size_t b = 0; b < kBuckets; ++b) order.ends[b + 1] += order.ends[b];
  order.cells.resize(placed.size());
  // What was a bucket's beginning is its end when it is full.
  for (const Placed& p : placed) order.cells[order.ends[static_cast<std::size_t>(p.bucket)]++] = p.cell;
  return order;
}

/// First pass over the cells, one bucket after the other.
class Erosion {
 public:
  Erosion(const DenseMap& map, std::vector<std::uint8_t>& marks)
      : marks_(marks), offsets_(neighbour_offsets(map)) {}

  /// Takes away what it can; what has to stay is appended to `kept`.
  void take(std::span<const std::uint32_t> bucket, std::vector<std::uint32_t>& kept) {
    last_.clear();
    for (const std::uint32_t i : bucket) {
      // A cell beside one that had to stay comes last: so the connection goes straight up the slope, and not
      // askew in the order of the cells' numbers.
      if (beside_kept(i)) {
        last_.push_back(i);
      } else {
        take_one(i, kept);
      }
    }
    for (const std::uint32_t i : last_) take_one(i, kept);
  }

 private:
  [[nodiscard]] bool beside_kept(std::uint32_t i) const {
    const std::uint8_t* m = &marks_[i];
    return ((m[offsets_[0]] | m[offsets_[2]] | m[offsets_[4]] | m[offsets_[6]]) & Thinning::kKept) != 0;
  }
  void take_one(std::uint32_t i, std::vector<std::uint32_t>& kept) {
    if ((marks_[i] & Thinning::kRidge) == 0 && kSimple[pattern_at(&marks_[i], offsets_)]) {
      marks_[i] = 0;
    } else {
      marks_[i] |= Thinning::kKept;
      kept.push_back(i);
    }
  }

  std::vector<std::uint8_t>& marks_;
  std::array<std::ptrdiff_t, 8> offsets_;
  std::vector<std::uint32_t> last_;
};

}  // namespace

std::array<std::ptrdiff_t, 8> neighbour_offsets(const DenseMap& map) {
  const std::ptrdiff_t up = map.width();
  return {1, up + 1, up, up - 1, -1, -up - 1, -up, -up + 1};
}

Thinning thin_to_ridge(const DenseMap& map, std::span<const float> clearance_m) {
  Thinning thinning{std::vector<std::uint8_t>(map.cells.size(), 0), {}};
  auto& marks = thinning.marks;
  for (std::size_t row = 1; row + 1 < static_cast<std::size_t>(std::max(map.height(), 1)); ++row)
    mark_row(map, clearance_m, row, marks);
  const Order order = by_clearance(map, clearance_m, marks);
  Erosion erosion(map, marks);
  std::size_t begin = 0;
  for (const std::size_t end : order.ends) {
    erosion.take(std::span(order.cells).subspan(begin, end - begin), thinning.remain);
    begin = end;
  }
  return thinning;
}

void thin_to_lines(const DenseMap& map, Thinning& thinning) {
  auto& marks = thinning.marks;
  const auto offsets = neighbour_offsets(map);
  std::vector<std::uint32_t> queue = thinning.remain;
  for (const std::uint32_t i : queue) marks[i] |= Thinning::kQueued;
  // A cell that must stay now may go when a neighbour is gone: every change brings its neighbours back.
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::uint32_t i = queue[next];
    marks[i] &= static_cast<std::uint8_t>(~Thinning::kQueued);
    const unsigned pattern = pattern_at(&marks[i], offsets);
    const bool end = (marks[i] & Thinning::kRidge) != 0 && std::popcount(pattern) < 2;
    if (end || !kSimple[pattern]) continue;
    marks[i] = 0;
    for (const std::ptrdiff_t offset : offsets) {
      const auto j = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offset);
      if ((marks[j] & (Thinning::kOn | Thinning::kQueued)) != Thinning::kOn) continue;
      marks[j] |= Thinning::kQueued;
      queue.push_back(j);
    }
  }
  std::erase_if(thinning.remain, [&](std::uint32_t i) { return marks[i] == 0; });
}

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/coarse_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/grid/known_span.hpp"

namespace topo::travel {
namespace {

// The largest state of several cells applies: occupied over free, free over unknown.
using grid::CellState;
static_assert(CellState::kUnknown < CellState::kFree && CellState::kFree < CellState::kOccupied);

/// The maximum of several rows in each column, then of neighbouring columns. The loops vectorise.
template <class T>
class Pooled {
 public:
  /// `before`: number of columns of the first coarse cell that lie before the rows' first column.
  Pooled(std::size_t coarse_width, int doublings, std::size_t before)
      : doublings_(doublings),
        before_(before),
        columns_(coarse_width << doublings),
        halved_(columns_.size()) {}

  /// Adds cells of a row, beginning with its cell `x`.
  void add(std::size_t x, const T* cells, std::size_t count) {
    T* const to = columns_.data() + before_ + x;
    for (std::size_t i = 0; i < count; ++i) to[i] = std::max(to[i], cells[i]);
  }
  /// Writes one value for each of the coarse cells [first, end) and resets them. All added cells must lie
  /// between them.
  void take(std::size_t first, std::size_t end, T* out) {
    T* const columns = columns_.data() + (first << doublings_);
    std::size_t width = (end - first) << doublings_;
    const T* from = columns;
    T* to = halved_.data();
    while (width > end - first) {
      width /= 2;
      halve(from, to, width);
      from = to;
      to += width;
    }
    std::copy_n(from, width, out);
    std::fill_n(columns, width << doublings_, T{});
  }

 private:
  static void halve(const T* from, T* to, std::size_t width) {
    for (std::size_t x = 0; x < width; ++x) {
      const T left = from[2 * x], right = from[2 * x + 1];
      to[x] = left < right ? right : left;
    }
  }

  int doublings_;
  std::size_t before_;
  std::vector<T> columns_, halved_;
};

}  // namespace

CoarseMap coarser(const grid::DenseMap& map, std::span<const float> clearance_m, int doublings) {
  CoarseMap out;
  out.map.resolution_m = std::ldexp(map.resolution_m, doublings);
  if (map.box.empty()) return out;
  const auto wide = [doublings](std::int32_t v) { return v >> doublings; };  // rounds towards minus infinity
  out.map.box.min = {wide(map.box.min.x) - 1, wide(map.box.min.y) - 1};
  out.map.box.max = {wide(map.box.max.x) + 1, wide(map.box.max.y) + 1};
  const auto width = static_cast<std::size_t>(map.width()),
             to_width = static_cast<std::size_t>(out.map.width());
  const auto size = to_width * static_cast<std::size_t>(out.map.height());
  out.map.cells.assign(size, CellState::kUnknown);
  out.clearance_m.assign(size, 0.0F);
  const auto before = static_cast<std::size_t>(map.box.min.x - (out.map.box.min.x << doublings));
  Pooled<CellState> states(to_width, doublings, before);
  Pooled<float> rooms_m(to_width, doublings, before);
  std::size_t row = 0;
  for (std::int32_t y = map.box.min.y; y <= map.box.max.y;) {
    const std::int32_t to_row = wide(y);
    std::size_t known = width, known_end = 0;
    for (; y <= map.box.max.y && wide(y) == to_row; ++y, row += width) {
      const auto [first, end] = grid::known_span(map.cells, row, row + width);
      if (first == end) continue;
      states.add(first - row, &map.cells[first], end - first);
      rooms_m.add(first - row, &clearance_m[first], end - first);
      known = std::min(known, first - row);
      known_end = std::max(known_end, end - row);
    }
    if (known >= known_end) continue;
    const std::size_t first = (before + known) >> doublings;
    const std::size_t end = ((before + known_end - 1) >> doublings) + 1;
    const std::size_t to = out.map.index({out.map.box.min.x, to_row});
    CellState* const state = &out.map.cells[to];
    float* const room_m = &out.clearance_m[to];
    states.take(first, end, state + first);
    rooms_m.take(first, end, room_m + first);
    for (std::size_t x = first; x < end; ++x) room_m[x] = state[x] == CellState::kFree ? room_m[x] : 0.0F;
  }
  return out;
}

}  // namespace topo::travel

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/clear_map.hpp"

#include <algorithm>
#include <cmath>

namespace topo::pipeline {
namespace {

// Of several states the most weighs: occupied over free, and free over unknown.
using grid::CellState;
static_assert(CellState::kUnknown < CellState::kFree && CellState::kFree < CellState::kOccupied);

/// The most of some rows in each column, then of neighbouring columns: whole rows in vector instructions.
template <class T>
class Pooled {
 public:
  /// `before`: columns of the first coarse cell that are before the rows' first.
  Pooled(std::size_t coarse_width, int doublings, std::size_t before)
      : doublings_(doublings),
        before_(before),
        columns_(coarse_width << doublings),
        halved_(columns_.size()) {}

  void clear() { std::fill(columns_.begin(), columns_.end(), T{}); }
  void add(const T* row, std::size_t width) {
    T* const to = columns_.data() + before_;
    for (std::size_t x = 0; x < width; ++x) to[x] = std::max(to[x], row[x]);
  }
  /// One value a coarse cell; the columns are used up.
  const T* cells() {
    std::size_t width = columns_.size();
    for (int i = 0; i < doublings_; ++i) {
      width /= 2;
      halve(columns_.data(), halved_.data(), width);
      columns_.swap(halved_);
    }
    return columns_.data();
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

ClearMap coarser(const grid::DenseMap& map, std::span<const float> clearance_m, int doublings) {
  ClearMap out;
  out.map.resolution_m = std::ldexp(map.resolution_m, doublings);
  if (map.box.empty()) return out;
  const auto wide = [doublings](std::int32_t v) { return v >> doublings; };  // towards minus infinity
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
  std::size_t from = 0;
  for (std::int32_t y = map.box.min.y; y <= map.box.max.y;) {
    const std::int32_t row = wide(y);
    states.clear();
    rooms_m.clear();
    for (; y <= map.box.max.y && wide(y) == row; ++y, from += width) {
      states.add(&map.cells[from], width);
      rooms_m.add(&clearance_m[from], width);
    }
    const CellState* state = states.cells();
    const float* room_m = rooms_m.cells();
    const std::size_t to = out.map.index({out.map.box.min.x, row});
    for (std::size_t x = 0; x < to_width; ++x) {
      out.map.cells[to + x] = state[x];
      out.clearance_m[to + x] = state[x] == CellState::kFree ? room_m[x] : 0.0F;
    }
  }
  return out;
}

}  // namespace topo::pipeline

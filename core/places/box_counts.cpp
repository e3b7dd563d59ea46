// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/box_counts.hpp"

#include <algorithm>

namespace topo::places {

using grid::CellState;

BoxCounts::BoxCounts(const grid::DenseMap& map, const CompassFrame& frame) : bin_m_(2.0 * map.resolution_m) {
  types::Rectangle extent;
  for (const int x : {0, map.width()}) {
    for (const int y : {0, map.height()}) {
      const types::Vector2 corner(map.box.min.x + x, map.box.min.y + y);
      extent.extend(frame.from_map(corner * map.resolution_m));
    }
  }
  if (map.cells.empty()) extent = {{0.0, 0.0}, {0.0, 0.0}};
  corner_ = extent.min;
  // One column and one row of zeros before the first bin.
  columns_ = static_cast<std::size_t>((extent.max.x() - corner_.x()) / bin_m_) + 3;
  rows_ = static_cast<std::size_t>((extent.max.y() - corner_.y()) / bin_m_) + 3;
  sums_.resize(columns_ * rows_);
  const double step = map.resolution_m / bin_m_;
  for (int y = 0; y < map.height(); ++y) {
    const types::Vector2 first =
        (frame.from_map(map.centre_of({map.box.min.x, map.box.min.y + y})) - corner_) / bin_m_;
    const CellState* row =
        map.cells.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width());
    for (int x = 0; x < map.width(); ++x) {
      if (row[x] == CellState::kUnknown) continue;
      const auto u = static_cast<std::size_t>(first.x() + x * step * frame.cos);
      const auto v = static_cast<std::size_t>(first.y() - x * step * frame.sin);
      Counts& bin = sums_[(v + 1) * columns_ + u + 1];
      (row[x] == CellState::kFree ? bin.free : bin.occupied) += 1;
    }
  }
  sum_up();
}

void BoxCounts::sum_up() {
  for (std::size_t v = 1; v < rows_; ++v) {
    Counts run;
    for (std::size_t u = 1; u < columns_; ++u) {
      Counts& here = sums_[v * columns_ + u];
      run = {run.free + here.free, run.occupied + here.occupied};
      const Counts& below = sums_[(v - 1) * columns_ + u];
      here = {run.free + below.free, run.occupied + below.occupied};
    }
  }
}

BoxCounts::Counts BoxCounts::in(const types::Rectangle& box) const {
  const auto bin = [&](double at, double corner, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp(std::round((at - corner) / bin_m_), 0.0, static_cast<double>(count - 1)));
  };
  const std::size_t u0 = bin(box.min.x(), corner_.x(), columns_),
                    u1 = bin(box.max.x(), corner_.x(), columns_);
  const std::size_t v0 = bin(box.min.y(), corner_.y(), rows_) * columns_;
  const std::size_t v1 = bin(box.max.y(), corner_.y(), rows_) * columns_;
  const Counts &a = sums_[v0 + u0], &b = sums_[v0 + u1], &c = sums_[v1 + u0], &d = sums_[v1 + u1];
  return {d.free - b.free - c.free + a.free, d.occupied - b.occupied - c.occupied + a.occupied};
}

}  // namespace topo::places

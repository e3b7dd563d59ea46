// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/narrow_passages.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <queue>
#include <tuple>

namespace topo::travel {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// For every free cell that is not reached, the narrowest cell of the widest way to it: a search in the order
/// of the clearance at that cell, from the cells beside those that are reached.
class WidestWays {
 public:
  WidestWays(const grid::DenseMap& map, std::span<const float> clearance_m, const grid::TravelField& field)
      : map_(map), clearance_m_(clearance_m), field_(field), narrowest_(map.cells.size(), kNone) {
    for (std::uint32_t i = 0; i < map_.cells.size(); ++i) {
      if (is_reached(i)) spread(i, i, HUGE_VALF);
    }
    while (!open_.empty()) {
      const auto [width_m, cell, at] = open_.top();
      open_.pop();
      if (narrowest_[cell] != kNone) continue;
      narrowest_[cell] = at;
      spread(cell, at, width_m);
    }
  }

  [[nodiscard]] std::uint32_t narrowest(std::uint32_t cell) const { return narrowest_[cell]; }

 private:
  [[nodiscard]] bool is_reached(std::uint32_t i) const { return std::isfinite(field_.cost_m[i]); }

  void spread(std::uint32_t from, std::uint32_t at, float width_m) {
    const grid::CellIndex c = map_.cell(from);
    for (const grid::CellIndex by : grid::kNeighbours) {
      const grid::CellIndex to{c.x + by.x, c.y + by.y};
      if (map_.state(to) != grid::CellState::kFree) continue;
      const auto i = static_cast<std::uint32_t>(map_.index(to));
      if (is_reached(i) || narrowest_[i] != kNone) continue;
      const bool is_narrower = clearance_m_[i] < width_m;
      open_.emplace(is_narrower ? clearance_m_[i] : width_m, i, is_narrower ? i : at);
    }
  }

  const grid::DenseMap& map_;
  std::span<const float> clearance_m_;
  const grid::TravelField& field_;
  std::vector<std::uint32_t> narrowest_;
  std::priority_queue<std::tuple<float, std::uint32_t, std::uint32_t>> open_;
};

}  // namespace

std::vector<NarrowPassage> narrow_passages(const grid::DenseMap& map, std::span<const float> clearance_m,
                                           const grid::TravelField& field,
                                           std::span<const std::uint32_t> ends) {
  assert(clearance_m.size() == map.cells.size() && field.cost_m.size() == map.cells.size());
  const WidestWays ways(map, clearance_m, field);
  std::vector<std::uint32_t> cells;
  for (const std::uint32_t end : ends) {
    if (ways.narrowest(end) != kNone) cells.push_back(ways.narrowest(end));
  }
  std::ranges::sort(cells);
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<NarrowPassage> passages;
  passages.reserve(cells.size());
  for (const std::uint32_t cell : cells)
    passages.push_back({map.centre_of(map.cell(cell)), 2.0 * static_cast<double>(clearance_m[cell])});
  return passages;
}

}  // namespace topo::travel

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/far_route.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace topo::travel {
namespace {

using grid::CellIndex;
using grid::CellState;
using grid::DenseMap;

/// Binary logarithm of the ratio of the cell widths.
int doublings(const DenseMap& map, const DenseMap& coarse) {
  return static_cast<int>(std::lround(std::log2(coarse.resolution_m / map.resolution_m)));
}

/// The coarse cells that routes with a cost of at most `most_m` lead through, and their bounding box.
struct Passage {
  std::vector<std::uint8_t> is_open;
  grid::CellBox box;
};

Passage passage(const DenseMap& coarse, const grid::TravelField& there, const grid::TravelField& back,
                float most_m) {
  Passage open;
  open.is_open.resize(coarse.cells.size());
  for (std::size_t i = 0; i < coarse.cells.size(); ++i) {
    if (there.cost_m[i] + back.cost_m[i] > most_m) continue;
    open.is_open[i] = 1;
    open.box.extend(coarse.cell(i));
  }
  return open;
}

/// Copies the part of the map that lies in the passage; the rest is unknown.
void take_part(const DenseMap& map, std::span<const float> clearance_m, const DenseMap& coarse,
               const Passage& open, CoarseMap& out) {
  const int shift = doublings(map, coarse);
  const int side = 1 << shift;
  out.map.resolution_m = map.resolution_m;
  out.map.box.min = {std::max(open.box.min.x * side - 1, map.box.min.x),
                     std::max(open.box.min.y * side - 1, map.box.min.y)};
  out.map.box.max = {std::min((open.box.max.x + 1) * side, map.box.max.x),
                     std::min((open.box.max.y + 1) * side, map.box.max.y)};
  const auto width = static_cast<std::size_t>(out.map.width());
  out.map.cells.assign(width * static_cast<std::size_t>(out.map.height()), CellState::kUnknown);
  out.clearance_m.assign(out.map.cells.size(), 0.0F);
  for (std::int32_t y = out.map.box.min.y; y <= out.map.box.max.y; ++y) {
    const std::uint8_t* is_open = &open.is_open[coarse.index({coarse.box.min.x, y >> shift})];
    for (std::int32_t x = out.map.box.min.x; x <= out.map.box.max.x;) {
      const std::int32_t end = std::min(((x >> shift) + 1) * side, out.map.box.max.x + 1);
      if (is_open[(x >> shift) - coarse.box.min.x] != 0) {
        const std::size_t from = map.index({x, y}), to = out.map.index({x, y});
        for (std::size_t i = 0; i < static_cast<std::size_t>(end - x); ++i) {
          out.map.cells[to + i] = map.cells[from + i];
          out.clearance_m[to + i] = clearance_m[from + i];
        }
      }
      x = end;
    }
  }
}

}  // namespace

std::vector<CellIndex> FarRoute::find(const DenseMap& map, std::span<const float> clearance_m,
                                      const CoarseMap& coarse, const grid::TravelField& coarse_field,
                                      CellIndex start, CellIndex target, const grid::TravelRules& rules,
                                      const FarRouteParams& params) {
  const CellIndex goal = coarse.map.cell_at(map.centre_of(target));
  const float cost_m = coarse_field.cost_m[coarse.map.index(goal)];
  if (std::isinf(cost_m)) return {};
  search_.begin(coarse.map, coarse.clearance_m, goal, rules, back_);
  const double most_m = params.factor * static_cast<double>(cost_m) + params.more_m;
  search_.settle(most_m);
  take_part(map, clearance_m, coarse.map,
            passage(coarse.map, coarse_field, back_, static_cast<float>(most_m)), corridor_);
  search_.begin(corridor_.map, corridor_.clearance_m, start, rules, field_);
  search_.settle(HUGE_VAL);
  // The coarse map may hide a tight door. At a cost above this bound, another route may be cheaper.
  const auto fine_m = static_cast<double>(field_.cost_m[corridor_.map.index(target)]);
  if (fine_m > most_m + rules.tightness * map.resolution_m) return {};
  return grid::route_to(corridor_.map, field_, target);
}

}  // namespace topo::travel

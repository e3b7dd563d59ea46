// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/wall_sides.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "core/places/segmentation/cell_tiles.hpp"

namespace topo::places {
namespace {

using grid::DenseMap;
using types::Segment;
using Labels = std::span<const std::uint32_t>;

constexpr double kStepM = 0.10;

/// Reaches across the wall's thickness to the regions that the wall bounds.
constexpr double kReachM = 0.40;

/// The first label from `p` in the given direction, within kReachM; 0 when there is none.
std::uint32_t label_beside(const DenseMap& map, Labels labels, const types::Vector2& p,
                           const types::Vector2& direction) {
  for (double d = 0.5 * map.resolution_m; d <= kReachM; d += map.resolution_m) {
    const grid::CellIndex cell = map.cell_at(p + d * direction);
    if (!map.contains(cell)) return 0;
    const std::uint32_t label = labels[map.index(cell)];
    if (label != 0) return label;
  }
  return 0;
}

/// Calls f(a, b) for every step of a wall with labels on both sides.
template <class F>
void for_each_step(const DenseMap& map, Labels labels, const Segment& wall, F&& f) {
  const double length_m = wall.length_m();
  const types::Vector2 along = (wall.b - wall.a) / length_m, across(-along.y(), along.x());
  for (double d = 0.5 * kStepM; d < length_m; d += kStepM) {
    const types::Vector2 p = wall.a + d * along;
    const std::uint32_t a = label_beside(map, labels, p, across);
    if (a == 0) continue;
    const std::uint32_t b = label_beside(map, labels, p, -across);
    if (b != 0) f(a, b);
  }
}

bool has_length(const Segment& wall) {
  const double length_m = wall.length_m();
  return length_m > 0.0 && std::isfinite(length_m);
}

bool comes_before(const Segment& l, const Segment& r) {
  return std::tuple(l.a.y(), l.a.x(), l.b.y(), l.b.x()) < std::tuple(r.a.y(), r.a.x(), r.b.y(), r.b.x());
}

/// Tiles that contain all changed cells.
std::optional<CellTiles> changed_tiles(const DenseMap& map, const std::optional<LabelChange>& change) {
  if (!change) return std::nullopt;
  CellTiles tiles(map);
  for (const grid::CellRun& run : change->cells) tiles.add(run);
  return tiles;
}

/// The box of the cells tested for a wall, with a margin of one cell for rounding.
grid::CellBox reach_of(const DenseMap& map, const Segment& wall) {
  const double margin_m = kReachM + map.resolution_m;
  const types::Vector2 margin(margin_m, margin_m);
  return {map.cell_at(wall.a.cwiseMin(wall.b) - margin), map.cell_at(wall.a.cwiseMax(wall.b) + margin)};
}

}  // namespace

float wall_length_m(std::uint32_t steps) {
  float length_m = 0.0F;
  for (; steps > 0; --steps) length_m += static_cast<float>(kStepM);
  return length_m;
}

void WallSides::take(const DenseMap& map, Labels labels, std::span<const Segment> walls,
                     const std::optional<LabelChange>& change) {
  const std::vector<Wall> walls_before = std::exchange(walls_, {});
  const std::vector<WallBetween> all_before = std::exchange(all_, {});
  const std::optional<CellTiles> changed = changed_tiles(map, change);
  const auto kept = [&](const Segment& wall) -> const Wall* {
    if (!changed || changed->may_have(reach_of(map, wall))) return nullptr;
    const auto known =
        std::lower_bound(walls_before.begin(), walls_before.end(), wall,
                         [](const Wall& w, const Segment& s) { return comes_before(w.segment, s); });
    return known == walls_before.end() || comes_before(wall, known->segment) ? nullptr : &*known;
  };
  for (const Segment& wall : walls) {
    if (!has_length(wall)) continue;
    const std::size_t first = all_.size();
    if (const Wall* const known = kept(wall)) {
      const auto from = all_before.begin() + static_cast<std::ptrdiff_t>(known->first);
      all_.insert(all_.end(), from, from + static_cast<std::ptrdiff_t>(known->count));
    } else {
      for_each_step(map, labels, wall, [&](std::uint32_t a, std::uint32_t b) {
        if (all_.size() == first || all_.back().a != a || all_.back().b != b) all_.push_back({a, b, 0});
        ++all_.back().steps;
      });
    }
    walls_.push_back({wall, first, all_.size() - first});
  }
  std::sort(walls_.begin(), walls_.end(),
            [](const Wall& l, const Wall& r) { return comes_before(l.segment, r.segment); });
}

}  // namespace topo::places

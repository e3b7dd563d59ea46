// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/viewpoint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace topo::exploration {
namespace {

using grid::CellBox;
using grid::CellIndex;
using grid::CellState;
using grid::DenseMap;
using types::Vector2;

// Sizes of tables of directions: at the reach of a viewpoint, neighbouring rays are at most three cells
// apart.
constexpr std::size_t kSourceRays = 180;
constexpr std::size_t kRobotRays = 270;

/// A value for each cell of a box.
template <class T>
class Window {
 public:
  explicit Window(const CellBox& box)
      : box_(box), values_(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height())) {}

  [[nodiscard]] const CellBox& box() const { return box_; }
  /// Null outside the box.
  [[nodiscard]] T* find(CellIndex c) {
    if (c.x < box_.min.x || c.x > box_.max.x || c.y < box_.min.y || c.y > box_.max.y) return nullptr;
    return &values_[static_cast<std::size_t>(c.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
                    static_cast<std::size_t>(c.x - box_.min.x)];
  }

 private:
  CellBox box_;
  std::vector<T> values_;
};

/// Directions at equal angles over a full turn.
template <std::size_t kRays>
const std::array<Vector2, kRays>& directions() {
  static const std::array<Vector2, kRays> all = [] {
    std::array<Vector2, kRays> made;
    for (std::size_t k = 0; k < kRays; ++k) {
      const double bearing_rad = 2.0 * std::numbers::pi * static_cast<double>(k) / kRays;
      made[k] = {std::cos(bearing_rad), std::sin(bearing_rad)};
    }
    return made;
  }();
  return all;
}

/// Calls meet(cell) for the cells of a ray, without the first, until it returns false.
template <class Meet>
void cast_ray(CellIndex from, const Vector2& direction, int steps, Meet meet) {
  for (int k = 1; k <= steps; ++k) {
    if (!meet(CellIndex{from.x + grid::floor_of(k * direction.x() + 0.5),
                        from.y + grid::floor_of(k * direction.y() + 0.5)}))
      return;
  }
}

/// Unknown cells beside a frontier, sampled evenly.
std::vector<CellIndex> unknown_beside(const DenseMap& map, const goals::Frontier& frontier,
                                      std::size_t sources_max) {
  std::vector<CellIndex> all;
  for (const std::uint32_t i : frontier.cells) {
    const CellIndex c = map.cell(i);
    for (std::size_t d = 0; d < grid::kNeighbours.size(); d += 2) {
      const CellIndex beside{c.x + grid::kNeighbours[d].x, c.y + grid::kNeighbours[d].y};
      if (map.state(beside) != CellState::kUnknown) continue;
      all.push_back(beside);
      break;
    }
  }
  // A cell beside several frontier cells counts once.
  const auto key = [](const CellIndex& c) { return std::pair(c.y, c.x); };
  std::ranges::sort(all, {}, key);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  if (all.size() <= sources_max) return all;
  std::vector<CellIndex> some;
  for (std::size_t k = 0; k < sources_max; ++k)
    some.push_back(all[(2 * k + 1) * all.size() / (2 * sources_max)]);
  return some;
}

/// Counts how many of some unknown cells are visible from around, by blocks of two by two cells: at three
/// metres the rays of one source are that far apart.
class Sights {
 public:
  Sights(const DenseMap& map, const CellBox& around, int steps, const ViewpointParams& params)
      : map_(map),
        around_(around),
        blocks_({block_of(around.min), block_of(around.max)}),
        params_(params),
        steps_(steps) {}

  void add(CellIndex source) {
    ++number_;
    for (const Vector2& direction : directions<kSourceRays>()) {
      int rim = params_.rim_cells;
      cast_ray(source, direction, steps_, [&](CellIndex c) {
        Block* block = blocks_.find(block_of(c));
        const CellState state = map_.state(c);
        if (block == nullptr || state == CellState::kOccupied) return false;
        if (state == CellState::kUnknown) return rim-- > 0;
        rim = 0;
        if (block->by != number_) ++block->sources;
        block->by = number_;
        return true;
      });
    }
  }

  /// Of the reachable cells that see nearly the largest number of sources, the one nearest to `centre`.
  std::optional<CellIndex> best(const grid::TravelField& field, const Vector2& centre) {
    int most = params_.sources_min;
    std::vector<std::pair<CellIndex, int>> reached;
    for (std::int32_t y = around_.min.y; y <= around_.max.y; ++y) {
      for (std::int32_t x = around_.min.x; x <= around_.max.x; ++x) {
        const int sources = blocks_.find(block_of({x, y}))->sources;
        if (sources < params_.sources_min || !field.can_stay_at(map_.index({x, y}))) continue;
        reached.emplace_back(CellIndex{x, y}, sources);
        most = std::max(most, sources);
      }
    }
    std::optional<CellIndex> nearest;
    double nearest_m2 = HUGE_VAL;
    for (const auto& [cell, sources] : reached) {
      const double away_m2 = (map_.centre_of(cell) - centre).squaredNorm();
      if (sources < params_.nearly_all * most || away_m2 >= nearest_m2) continue;
      nearest = cell;
      nearest_m2 = away_m2;
    }
    return nearest;
  }

 private:
  struct Block {
    int sources = 0, by = 0;
  };
  static CellIndex block_of(CellIndex c) { return {c.x >> 1, c.y >> 1}; }

  const DenseMap& map_;
  CellBox around_;
  Window<Block> blocks_;
  const ViewpointParams& params_;
  int steps_, number_ = 0;
};

enum class Unseen : std::uint8_t { kOpen, kCounted, kWall };

/// False when the wall lies entirely on one side of the box.
bool may_meet(const DenseMap& map, const types::Segment& wall, double on_m, const CellBox& box) {
  const Vector2 more(on_m + 2.0 * map.resolution_m, on_m + 2.0 * map.resolution_m);
  const CellIndex low = map.cell_at(wall.a.cwiseMin(wall.b) - more),
                  high = map.cell_at(wall.a.cwiseMax(wall.b) + more);
  return low.x <= box.max.x && low.y <= box.max.y && high.x >= box.min.x && high.y >= box.min.y;
}

void draw_wall(const DenseMap& map, const types::Segment& wall, double on_m, Window<Unseen>& cells) {
  const double length_m = wall.length_m(), step_m = 0.5 * map.resolution_m;
  if (length_m < step_m || !may_meet(map, wall, on_m, cells.box())) return;
  const Vector2 along = (wall.b - wall.a) / length_m;
  for (double s_m = -on_m; s_m < length_m + on_m; s_m += step_m) {
    const CellIndex c = map.cell_at(wall.a + s_m * along);
    // Two cells thick: no ray passes the corner between two cells.
    for (const CellIndex& d : {c, CellIndex{c.x + 1, c.y}, CellIndex{c.x, c.y + 1}}) {
      if (Unseen* cell = cells.find(d)) *cell = Unseen::kWall;
    }
  }
}

/// Counts the unknown cells of a window that may become visible.
Viewpoint look_from(const DenseMap& map, CellIndex from, int steps, Window<Unseen>& cells) {
  Viewpoint look{from, from, 0.0};
  int count = 0;
  std::vector<CellIndex> beyond;
  std::size_t longest = 0;
  for (const Vector2& direction : directions<kRobotRays>()) {
    beyond.clear();
    cast_ray(from, direction, steps, [&](CellIndex c) {
      const CellState state = map.state(c);
      if (state == CellState::kFree) return beyond.empty();
      Unseen* cell = cells.find(c);
      if (state == CellState::kOccupied || cell == nullptr || *cell == Unseen::kWall) return false;
      beyond.push_back(c);
      if (*cell == Unseen::kOpen) ++count;
      *cell = Unseen::kCounted;
      return true;
    });
    if (beyond.size() <= longest) continue;
    longest = beyond.size();
    look.sight = beyond[longest / 2];
  }
  look.gain_m2 = count * map.resolution_m * map.resolution_m;
  return look;
}

}  // namespace

std::optional<Viewpoint> find_viewpoint(const DenseMap& map, const goals::Frontier& frontier,
                                        const grid::TravelField& field, std::span<const types::Segment> walls,
                                        const ViewpointParams& params) {
  if (frontier.cells.empty()) return std::nullopt;
  const auto cells_in = [&](double length_m) { return static_cast<int>(length_m / map.resolution_m); };
  const int reach = cells_in(params.reach_m), behind = cells_in(params.behind_m);
  CellBox around;
  for (const std::uint32_t i : frontier.cells) around.extend(map.cell(i));
  around.min = {std::max(around.min.x - reach, map.box.min.x), std::max(around.min.y - reach, map.box.min.y)};
  around.max = {std::min(around.max.x + reach, map.box.max.x), std::min(around.max.y + reach, map.box.max.y)};
  Sights sights(map, around, reach, params);
  for (const CellIndex& source : unknown_beside(map, frontier, params.sources_max)) sights.add(source);
  const auto from = sights.best(field, frontier.centroid);
  if (!from) return std::nullopt;
  const CellIndex centre = map.cell_at(frontier.centroid);
  Window<Unseen> unseen({{centre.x - behind, centre.y - behind}, {centre.x + behind, centre.y + behind}});
  for (const types::Segment& wall : walls) draw_wall(map, wall, params.wall_on_m, unseen);
  const Viewpoint look = look_from(map, *from, reach + behind, unseen);
  return look.gain_m2 > 0.0 ? std::optional(look) : std::nullopt;
}

}  // namespace topo::exploration

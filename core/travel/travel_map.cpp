// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/travel_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/grid/cell_block.hpp"
#include "core/grid/known_span.hpp"
#include "core/grid/occupancy_grid.hpp"
#include "core/grid/wavefront.hpp"
#include "core/types/beam_directions.hpp"

namespace topo::travel {
namespace {

using grid::CellIndex;
using grid::CellState;
using grid::DenseMap;
using types::Vector2;

constexpr int kBlock = grid::kCellBlock;
using Block = std::array<std::uint8_t, kBlock>;

/// For each of `count` cells beginning at `from`: 1 when the nearest known cell in steps of `stride`, at most
/// `reach` steps away, is free.
void see_free(const CellState* from, int count, std::ptrdiff_t stride, int reach, Block& sees) {
  std::fill_n(sees.begin(), count, std::uint8_t{0});
  for (int step = reach; step >= 1; --step) {
    const CellState* at = from + step * stride;
    for (int x = 0; x < count; ++x) {
      const auto free = static_cast<std::uint8_t>(at[x] == CellState::kFree);
      const auto unknown = static_cast<std::uint8_t>(at[x] == CellState::kUnknown);
      sees[static_cast<std::size_t>(x)] =
          static_cast<std::uint8_t>(free | (unknown & sees[static_cast<std::size_t>(x)]));
    }
  }
}

/// Marks the cells that are unknown and between free ones. False when there are none.
bool between_free(const CellState* from, int count, std::span<const std::ptrdiff_t> strides, int reach,
                  Block& between) {
  Block one, other;
  std::fill_n(between.begin(), count, std::uint8_t{0});
  for (const std::ptrdiff_t stride : strides) {
    see_free(from, count, stride, reach, one);
    see_free(from, count, -stride, reach, other);
    for (std::size_t x = 0; x < static_cast<std::size_t>(count); ++x)
      between[x] = static_cast<std::uint8_t>(between[x] | (one[x] & other[x]));
  }
  std::uint8_t any = 0;
  for (int x = 0; x < count; ++x) {
    const auto unknown = static_cast<std::uint8_t>(from[x] == CellState::kUnknown);
    std::uint8_t& here = between[static_cast<std::size_t>(x)];
    here = static_cast<std::uint8_t>(here & unknown);
    any = static_cast<std::uint8_t>(any | here);
  }
  return any != 0;
}

/// True when all cells have this state. Most blocks of a map are entirely unknown, or known.
bool is_all(const CellState* from, int count, CellState state) {
  std::uint8_t other = 0;
  for (int x = 0; x < count; ++x)
    other = static_cast<std::uint8_t>(other | static_cast<std::uint8_t>(from[x] != state));
  return other == 0;
}

/// True when none of these cells can change: none is unknown, or all cells around them are.
bool is_settled(const CellState* from, int count, std::ptrdiff_t width, int reach) {
  if (std::memchr(from, static_cast<int>(CellState::kUnknown), static_cast<std::size_t>(count)) == nullptr)
    return true;
  for (int y = -reach; y <= reach; ++y) {
    if (!is_all(from + y * width - reach, count + 2 * reach, CellState::kUnknown)) return false;
  }
  return true;
}

/// The columns between which cells are known, by row.
class KnownColumns {
 public:
  struct Columns {
    int first, end;
  };

  KnownColumns(const DenseMap& map, int reach) : reach_(reach) {
    const auto width = static_cast<std::size_t>(map.width());
    for (std::size_t row = 0; row < map.cells.size(); row += width) {
      const auto [first, end] = grid::known_span(map.cells, row, row + width);
      if (first == end)
        of_row_.push_back({map.width(), 0});
      else
        of_row_.push_back({static_cast<int>(first - row), static_cast<int>(end - row)});
    }
  }

  /// The columns of all rows within `reach` of this one.
  [[nodiscard]] Columns around(int row) const {
    Columns all = of_row_[static_cast<std::size_t>(row - reach_)];
    for (int y = row - reach_ + 1; y <= row + reach_; ++y) {
      const Columns& there = of_row_[static_cast<std::size_t>(y)];
      all = {std::min(all.first, there.first), std::max(all.end, there.end)};
    }
    return all;
  }

 private:
  int reach_;
  std::vector<Columns> of_row_;
};

/// Crossings of the horizontal line at `y_m` with a polygon's edges, in order of x.
void crossings(const types::Polygon& polygon, double y_m, std::vector<double>& out) {
  out.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > y_m) == (b.y() > y_m)) continue;
    out.push_back(a.x() + (y_m - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(out.begin(), out.end());
}

/// Occupies the cells of one row whose centres are inside the polygon, or outside when `outside`.
void occupy_row(DenseMap& map, std::int32_t y, const std::vector<double>& crossings_m, bool outside) {
  std::size_t passed = 0;
  CellState* row = map.cells.data() + map.index({map.box.min.x, y});
  for (int i = 0; i < map.width(); ++i) {
    const double x_m = (map.box.min.x + i + 0.5) * map.resolution_m;
    while (passed < crossings_m.size() && crossings_m[passed] <= x_m) ++passed;
    const bool inside = passed % 2 == 1;
    if (inside != outside) row[i] = CellState::kOccupied;
  }
}

void occupy(DenseMap& map, const types::Polygon& polygon, bool outside) {
  std::vector<double> crossings_m;
  for (std::int32_t y = map.box.min.y; y <= map.box.max.y; ++y) {
    crossings(polygon, (y + 0.5) * map.resolution_m, crossings_m);
    if (outside || !crossings_m.empty()) occupy_row(map, y, crossings_m, outside);
  }
}

/// Calls visit(index, squared distance) for the cells within a radius of a point.
template <class Visit>
void for_each_around(const DenseMap& map, const Vector2& centre, double radius_m, Visit visit) {
  const CellIndex low = map.cell_at(centre - Vector2(radius_m, radius_m));
  const CellIndex high = map.cell_at(centre + Vector2(radius_m, radius_m));
  const std::int32_t left = std::max(low.x, map.box.min.x), right = std::min(high.x, map.box.max.x);
  const double radius_m2 = radius_m * radius_m;
  for (std::int32_t y = std::max(low.y, map.box.min.y); y <= std::min(high.y, map.box.max.y); ++y) {
    for (std::int32_t x = left; x <= right; ++x) {
      const double away_m2 = (map.centre_of({x, y}) - centre).squaredNorm();
      if (away_m2 <= radius_m2) visit(map.index({x, y}), away_m2);
    }
  }
}

/// In cells, around points of a driven line: a line of cells without a gap, and no wider. Beside the line the
/// robot may touch an obstacle.
constexpr double kLineReach = 0.75;

}  // namespace

void close_gaps(DenseMap& map, int reach) {
  static_assert(sizeof(CellState) == 1);
  const int w = map.width(), h = map.height();
  const std::array<std::ptrdiff_t, 4> strides{1, w, w + 1, w - 1};
  std::vector<std::size_t> closed;
  Block between;
  const KnownColumns known(map, reach);
  for (int y = reach; y < h - reach; ++y) {
    const CellState* row = map.cells.data() + static_cast<std::ptrdiff_t>(y) * w;
    const auto [first, end] = known.around(y);
    for (int x = std::max(reach, first); x < std::min(w - reach, end); x += kBlock) {
      const int count = std::min(kBlock, w - reach - x);
      if (is_settled(row + x, count, w, reach)) continue;
      if (!between_free(row + x, count, strides, reach, between)) continue;
      for (int i = 0; i < count; ++i) {
        if (between[static_cast<std::size_t>(i)] != 0)
          closed.push_back(static_cast<std::size_t>(row + x + i - map.cells.data()));
      }
    }
  }
  for (const std::size_t index : closed) map.cells[index] = CellState::kFree;
}

void free_disc(DenseMap& map, const Vector2& centre, double radius_m) {
  for_each_around(map, centre, radius_m, [&](std::size_t index, double) {
    if (map.cells[index] != CellState::kUnknown || map.is_on_border(map.cell(index))) return;
    map.cells[index] = CellState::kFree;
  });
}

void free_trail(DenseMap& map, const grid::OccupancyGrid& grid, const Vector2& centre, double radius_m) {
  for_each_around(map, centre, radius_m, [&](std::size_t index, double) {
    if (map.cells[index] == CellState::kOccupied && grid.state(map.cell(index)) != CellState::kOccupied)
      map.cells[index] = CellState::kFree;
  });
}

void free_start(DenseMap& map, const Vector2& centre, double radius_m) {
  const auto is_within = [&](CellIndex cell) { return (map.centre_of(cell) - centre).norm() <= radius_m; };
  std::vector<std::size_t> found;
  for_each_around(map, centre, radius_m, [&](std::size_t index, double) {
    if (map.cells[index] == CellState::kOccupied) found.push_back(index);
  });
  for (const std::size_t seed : found) {
    if (map.cells[seed] != CellState::kOccupied) continue;  // freed with another one
    std::vector<std::size_t> piece{seed};
    bool is_inside = true;
    for (std::size_t next = 0; next < piece.size() && is_inside; ++next) {
      const CellIndex at = map.cell(piece[next]);
      for (const CellIndex& step : grid::kNeighbours) {
        const CellIndex cell{at.x + step.x, at.y + step.y};
        if (map.state(cell) != CellState::kOccupied) continue;
        is_inside = is_inside && is_within(cell);
        const std::size_t index = map.index(cell);
        if (std::ranges::find(piece, index) == piece.end()) piece.push_back(index);
      }
    }
    if (!is_inside) continue;
    for (const std::size_t index : piece) map.cells[index] = CellState::kFree;
  }
}

void occupy_faint(DenseMap& map, const grid::OccupancyGrid& grid, const TravelMapParams& params) {
  constexpr int kSide = grid::Tile::kSide;
  grid.tiles().for_each([&](patricia::Key key, const grid::TileRef& tile) {
    const auto corner = patricia::cell_of(key);
    const auto& cells = tile.read().cells;
    for (int i = 0; i < kSide * kSide; ++i) {
      const grid::CellCounts& counts = cells[static_cast<std::size_t>(i)];
      const unsigned hits = counts.hits, all = hits + counts.misses;
      if (hits < params.faint_hits || params.faint_one_in * hits < all) continue;
      const CellIndex cell{corner.x * kSide + i % kSide, corner.y * kSide + i / kSide};
      if (map.contains(cell)) map.cells[map.index(cell)] = CellState::kOccupied;
    }
  });
}

void apply_limits(DenseMap& map, const types::AreaLimits& limits) {
  if (limits.keep_in) occupy(map, *limits.keep_in, true);
  for (const types::Polygon& polygon : limits.keep_out) occupy(map, polygon, false);
}

DenseMap prepare_map(const grid::OccupancyGrid& grid, const DrivenWays& ways, const types::AreaLimits& limits,
                     double route_radius_m, const TravelMapParams& params) {
  const int reach = static_cast<int>(std::lround(params.gap_m / grid.resolution_m()));
  const int disc = static_cast<int>(std::ceil(route_radius_m / grid.resolution_m())) + 1;
  DenseMap map = grid::dense_map(grid, std::max(2 * reach, disc));
  occupy_faint(map, grid, params);
  close_gaps(map, reach);
  const auto free_way = [&](std::span<const types::KeyframePose> way) {
    if (!way.empty() && !ways.mates.empty())
      free_start(map, way.front().T_map_base.se2().translation(), route_radius_m + params.start_noise_m);
    for (const types::KeyframePose& keyframe : way) {
      const Vector2 centre = keyframe.T_map_base.se2().translation();
      free_disc(map, centre, route_radius_m);
      free_trail(map, grid, centre, params.inner_share * route_radius_m);
    }
  };
  free_way(ways.own);
  for (std::span<const types::KeyframePose> way : ways.mates) free_way(way);
  apply_limits(map, limits);
  return map;
}

std::vector<Vector2> confirmed_points(const types::Scan& scan, const types::Se2& T_map_laser,
                                      double range_max_m, float step_m) {
  std::vector<Vector2> points;
  const auto confirmed = [&](std::size_t i, std::size_t neighbour) {
    return types::is_hit(scan.range_m[neighbour]) &&
           std::abs(scan.range_m[neighbour] - scan.range_m[i]) < step_m;
  };
  types::BeamDirections direction(scan.geometry, T_map_laser.theta_rad);
  for (std::size_t i = 1; i + 1 < scan.beams; ++i) {
    direction.advance();
    const double range_m = static_cast<double>(scan.range_m[i]);
    if (!types::is_hit(scan.range_m[i]) || range_m > range_max_m) continue;
    if (!confirmed(i, i - 1) || !confirmed(i, i + 1)) continue;
    points.emplace_back(T_map_laser.translation() + range_m * direction.now());
  }
  return points;
}

void lower_clearance(const DenseMap& map, std::span<const Vector2> obstacles, double reach_m,
                     std::vector<float>& clearance_m, MapObstacles of_map) {
  for (const Vector2& obstacle : obstacles) {
    const CellIndex cell = map.cell_at(obstacle);
    if (!map.contains(cell)) continue;
    if (of_map == MapObstacles::kSkip && clearance_m[map.index(cell)] <= 0.0F) continue;
    for_each_around(map, obstacle, reach_m, [&](std::size_t index, double away_m2) {
      clearance_m[index] = std::min(clearance_m[index], static_cast<float>(std::sqrt(away_m2)));
    });
  }
}

void keep_trail_open(const DenseMap& map, std::span<const types::KeyframePose> way, CellIndex here,
                     const TrailRules& rules, std::vector<float>& clearance_m) {
  const auto open_m = static_cast<float>(rules.open_m), above_m = static_cast<float>(rules.above_m);
  const Vector2 robot = map.centre_of(here);
  const std::size_t stands = map.contains(here) ? map.index(here) : map.cells.size();
  for_each_point(
      way, rules.gap_m, map.resolution_m,
      [&](const Vector2& b) { return (b - robot).norm() <= rules.within_m; },
      [&](const Vector2& p) {
        for_each_around(map, p, kLineReach * map.resolution_m, [&](std::size_t index, double) {
          if (map.cells[index] == CellState::kFree && index != stands && clearance_m[index] >= above_m)
            clearance_m[index] = std::max(clearance_m[index], open_m);
        });
      });
}

std::vector<std::size_t> open_seen_through(DenseMap& map, std::span<const Vector2> centres,
                                           const types::AreaLimits& limits,
                                           std::span<const Vector2> obstacles, double clear_m) {
  std::vector<std::size_t> opened;
  const auto is_clear = [&](const Vector2& p) {
    return std::ranges::none_of(obstacles, [&](const Vector2& o) { return (o - p).norm() < clear_m; });
  };
  for (const Vector2& p : centres) {
    const CellIndex cell = map.cell_at(p);
    if (map.state(cell) != CellState::kOccupied || !types::allows(limits, p) || !is_clear(p)) continue;
    opened.push_back(map.index(cell));
    map.cells[opened.back()] = CellState::kFree;
  }
  return opened;
}

std::vector<std::size_t> open_beneath(DenseMap& map, const Vector2& here, double radius_m,
                                      const types::AreaLimits& limits) {
  std::vector<std::size_t> opened;
  for_each_around(map, here, radius_m, [&](std::size_t index, double) {
    if (map.cells[index] != CellState::kOccupied || map.is_on_border(map.cell(index))) return;
    if (!types::allows(limits, map.centre_of(map.cell(index)))) return;
    map.cells[index] = CellState::kFree;
    opened.push_back(index);
  });
  return opened;
}

}  // namespace topo::travel

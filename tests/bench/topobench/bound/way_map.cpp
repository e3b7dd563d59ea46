// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/bound/way_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace topo::bench::bound {
namespace {

constexpr double kWayCell_m = 0.1;
constexpr int kNearest = 4;  // cells, in which the nearest place to a point is looked for

struct Move {
  int dx, dy;
  float cells;
};

const std::array<Move, 16>& moves() {
  static const std::array<Move, 16> kMoves = [] {
    std::array<Move, 16> all{};
    std::size_t n = 0;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const int longer = std::max(std::abs(dx), std::abs(dy)),
                  shorter = std::min(std::abs(dx), std::abs(dy));
        if (longer == 1 || (longer == 2 && shorter == 1))
          all[n++] = {dx, dy, static_cast<float>(std::hypot(dx, dy))};
      }
    }
    return all;
  }();
  return kMoves;
}

/// A knight's move passes two cells between its ends: both must be free.
bool is_open(const sim::Raster& places, int x, int y, const Move& move) {
  if (places.at(x + move.dx, y + move.dy) == 0) return false;
  if (std::abs(move.dx) + std::abs(move.dy) < 3) return true;
  const int hx = move.dx / 2, hy = move.dy / 2;  // along the longer side
  return places.at(x + hx, y + hy) != 0 && places.at(x + move.dx - hx, y + move.dy - hy) != 0;
}

}  // namespace

double length_m(const Way& way) {
  double sum = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) sum += (way[i] - way[i - 1]).norm();
  return sum;
}

WayMap::WayMap(const sim::Raster& poses) {
  const double w = poses.width * poses.resolution_m, h = poses.height * poses.resolution_m;
  places_ = sim::Raster(kWayCell_m, poses.origin, static_cast<int>(std::ceil(w / kWayCell_m)),
                        static_cast<int>(std::ceil(h / kWayCell_m)));
  for (int y = 0; y < poses.height; ++y) {
    for (int x = 0; x < poses.width; ++x) {
      if (poses.at(x, y) == 0) continue;
      const sim::Vector2 p = poses.center(x, y);
      places_.set(places_.column(p.x()), places_.row(p.y()), 1);
    }
  }
}

int WayMap::cell_of(const sim::Vector2& p) const {
  const int x = places_.column(p.x()), y = places_.row(p.y());
  for (int r = 0; r <= kNearest; ++r) {
    for (int dy = -r; dy <= r; ++dy) {
      for (int dx = -r; dx <= r; ++dx) {
        if (std::max(std::abs(dx), std::abs(dy)) == r && places_.at(x + dx, y + dy) != 0)
          return static_cast<int>(places_.index(x + dx, y + dy));
      }
    }
  }
  return -1;
}

WayMap::Field WayMap::field_to(std::span<const sim::Vector2> places) const {
  Field field(places_.cells.size(), std::numeric_limits<float>::infinity());
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const sim::Vector2& place : places) {
    const int cell = cell_of(place);
    if (cell < 0) continue;
    field[static_cast<std::size_t>(cell)] = 0.0F;
    open.emplace(0.0F, cell);
  }
  while (!open.empty()) {
    const auto [cost, cell] = open.top();
    open.pop();
    if (cost > field[static_cast<std::size_t>(cell)]) continue;
    const int x = cell % places_.width, y = cell / places_.width;
    for (const Move& move : moves()) {
      if (!is_open(places_, x, y, move)) continue;
      const std::size_t next = places_.index(x + move.dx, y + move.dy);
      const float there = cost + move.cells * static_cast<float>(kWayCell_m);
      if (there >= field[next]) continue;
      field[next] = there;
      open.emplace(there, static_cast<int>(next));
    }
  }
  return field;
}

double WayMap::distance_m(const Field& field, const sim::Vector2& from) const {
  const int cell = cell_of(from);
  return cell < 0 ? HUGE_VAL : static_cast<double>(field[static_cast<std::size_t>(cell)]);
}

bool WayMap::is_straight(const sim::Vector2& a, const sim::Vector2& b) const {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / (0.5 * kWayCell_m))));
  for (int i = 0; i <= steps; ++i) {
    if (places_.at(a + (b - a) * (static_cast<double>(i) / steps)) == 0) return false;
  }
  return true;
}

Way WayMap::way(const Field& field, const sim::Vector2& from) const {
  int cell = cell_of(from);
  if (cell < 0 || !std::isfinite(field[static_cast<std::size_t>(cell)])) return {};
  Way cells;
  while (true) {
    const int x = cell % places_.width, y = cell / places_.width;
    cells.push_back(places_.center(x, y));
    int best = cell;
    float least = field[static_cast<std::size_t>(cell)];
    if (least <= 0.0F) break;
    for (const Move& move : moves()) {
      if (!is_open(places_, x, y, move)) continue;
      const std::size_t next = places_.index(x + move.dx, y + move.dy);
      const float through = field[next] + move.cells * static_cast<float>(kWayCell_m);
      if (field[next] < field[static_cast<std::size_t>(cell)] && through < least + 1e-3F) {
        best = static_cast<int>(next);
        least = std::min(least, through);
      }
    }
    if (best == cell) break;
    cell = best;
  }
  Way pulled{cells.front()};
  for (std::size_t i = 0; i + 1 < cells.size();) {
    std::size_t next = i + 1;
    for (std::size_t k = cells.size() - 1; k > next; k = i + (k - i) / 2) {
      if (is_straight(cells[i], cells[k])) {
        next = k;
        break;
      }
    }
    pulled.push_back(cells[next]);
    i = next;
  }
  return pulled;
}

}  // namespace topo::bench::bound

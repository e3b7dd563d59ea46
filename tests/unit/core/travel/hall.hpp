// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/travel/route_map.hpp"
#include "tests/unit/core/travel/counted_cells.hpp"

namespace topo::travel {

using Doors = std::vector<std::pair<int, int>>;
using Way = std::vector<types::KeyframePose>;

inline types::KeyframePose stands_at(double x_m, double y_m) {
  return {types::Stamp{}, types::Transform2<types::Map, types::Base>(x_m, y_m, 0.0)};
}

/// A hall of 8 by 4 m within walls, and a wall across at x = 4 m with doors, from y to y in cells.
struct Hall {
  static constexpr int kWidth = 160, kHeight = 80, kWallX = 80;
  static constexpr double kMiddle_m = 2.025;
  CountedCells cells;
  Way way;
  std::vector<Way> mates;
  grid::TravelRules rules;
  types::AreaLimits area;
  Overlays overlays;

  explicit Hall(const Doors& doors = {{0, kHeight}}) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool outer = x == 0 || y == 0 || x == kWidth - 1 || y == kHeight - 1;
        const bool in_door = std::any_of(
            doors.begin(), doors.end(), [&](const auto& door) { return y >= door.first && y < door.second; });
        const bool is_wall = outer || (x == kWallX && !in_door);
        cells.put({x, y}, is_wall ? 5 : 0, is_wall ? 0 : 5);
      }
    }
  }
  [[nodiscard]] DrivenWays ways() const { return {way, mates}; }
  [[nodiscard]] std::vector<types::Vector2> route(const types::Vector2& from, const types::Vector2& to) const;
  [[nodiscard]] bool has_way_through(double from_x_m = 1.5) const {
    return !route({from_x_m, kMiddle_m}, {6.5, kMiddle_m}).empty();
  }
  void drive_through() {
    for (double x = 0.5; x < 7.0; x += 0.5) way.push_back(stands_at(x, kMiddle_m));
  }
};

/// The map of a hall, with the searches of a period begun.
struct RoutesIn : RouteMap {
  RoutesIn(const Hall& hall, const types::KeyframePose& here) : RouteMap(hall.rules, hall.area) {
    take(1, hall.cells.grid(), hall.ways());
    begin(here, hall.ways(), hall.overlays);
  }
};

inline std::vector<types::Vector2> Hall::route(const types::Vector2& from, const types::Vector2& to) const {
  RoutesIn map(*this, stands_at(from.x(), from.y()));
  return map.route_to(map.map().cell_at(to));
}

inline const Doors kOneDoor{{30, 51}};  // 1.05 m, its middle at y = kMiddle_m

}  // namespace topo::travel

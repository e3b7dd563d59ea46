// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/core/places/building.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

/// The map turned about its middle, each cell from the nearest one, and moved by whole cells.
DenseMap turned_by(const DenseMap& map, double angle_rad, grid::CellIndex by) {
  const double half_m = 0.5 * std::hypot(map.width(), map.height()) * map.resolution_m;
  const types::Vector2 middle =
      map.centre_of({(map.box.min.x + map.box.max.x) / 2, (map.box.min.y + map.box.max.y) / 2});
  const auto side = static_cast<int>(std::ceil(half_m / map.resolution_m)) + 1;
  DenseMap out;
  out.resolution_m = map.resolution_m;
  out.box = {{by.x - side, by.y - side}, {by.x + side, by.y + side}};
  const CompassFrame turn(angle_rad);
  const types::Vector2 moved_m(by.x * map.resolution_m, by.y * map.resolution_m);
  out.cells.resize(static_cast<std::size_t>(out.width()) * static_cast<std::size_t>(out.height()));
  for (std::size_t i = 0; i < out.cells.size(); ++i)
    out.cells[i] = map.state(map.cell_at(middle + turn.from_map(out.centre_of(out.cell(i)) - moved_m)));
  return out;
}

/// Labels of the turned map at the cells of the map itself.
std::vector<std::uint16_t> turned_back(const DenseMap& map, const DenseMap& turned, const PlaceLabels& labels,
                                       double angle_rad, grid::CellIndex by) {
  const types::Vector2 middle =
      map.centre_of({(map.box.min.x + map.box.max.x) / 2, (map.box.min.y + map.box.max.y) / 2});
  const CompassFrame turn(angle_rad);
  const types::Vector2 moved_m(by.x * map.resolution_m, by.y * map.resolution_m);
  std::vector<std::uint16_t> out(map.cells.size(), 0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const grid::CellIndex cell = turned.cell_at(moved_m + turn.to_map(map.centre_of(map.cell(i)) - middle));
    if (turned.contains(cell)) out[i] = labels[turned.index(cell)];
  }
  return out;
}

double worst_overlap(const std::vector<std::uint16_t>& labels, const std::vector<std::uint16_t>& others) {
  double worst = 1.0;
  for (const auto& [share, cells] : best_overlaps(labels, others)) worst = std::min(worst, share);
  return worst;
}

/// The paper's figure 7: clutter changes nothing in the places.
TEST(Building, HasTheSamePlacesCleanAndCluttered) {
  const DrawnMap clean = clean_building(), cluttered = cluttered_building();
  const PlaceMap expected = places_of_building(clean.map()), found = places_of_building(cluttered.map());
  EXPECT_EQ(expected.places.size(), 10U) << "eight rooms and the corridor's two arms";
  EXPECT_EQ(found.places.size(), expected.places.size());
  const auto labels = expected.labels.by_cell(clean.map().cells.size()),
             others = found.labels.by_cell(cluttered.map().cells.size());
  EXPECT_GE(worst_overlap(labels, others), 0.9);
  EXPECT_GE(worst_overlap(others, labels), 0.9);
}

/// Any turn, any shift: the same places within the width of a cell or two.
TEST(Building, KeepsItsPlacesWhenTurnedAndShifted) {
  const DrawnMap drawn = cluttered_building();
  const PlaceMap expected = places_of_building(drawn.map());
  const auto labels = expected.labels.by_cell(drawn.map().cells.size());
  EXPECT_TRUE(rc::check([&] {
    const double angle_rad = *rc::gen::inRange(0, 360) * 0.0174532925199433;
    const grid::CellIndex by{*rc::gen::inRange(-5000, 5000), *rc::gen::inRange(-5000, 5000)};
    const DenseMap turned = turned_by(drawn.map(), angle_rad, by);
    const PlaceMap found = places_of_building(turned);
    const auto back = turned_back(drawn.map(), turned, found.labels, angle_rad, by);
    RC_ASSERT(found.places.size() == expected.places.size());
    RC_ASSERT(worst_overlap(labels, back) >= 0.95);
  }));
}

}  // namespace
}  // namespace topo::places

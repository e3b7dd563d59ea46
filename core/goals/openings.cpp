// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/openings.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "core/goals/frontiers.hpp"
#include "core/places/segmentation/box_counts.hpp"

namespace topo::goals {
namespace {

using places::CompassFrame;

/// The place label of a frontier's middle, else of the first of its cells that has one; 0 without any.
std::uint16_t place_of(const GoalInput& input, std::uint32_t middle, const Frontier& frontier) {
  if (const std::uint16_t place = input.places.labels[middle]; place != 0) return place;
  for (const std::uint32_t i : frontier.cells)
    if (const std::uint16_t place = input.places.labels[i]; place != 0) return place;
  return 0;
}

}  // namespace

Side nearest_side(const places::PlaceMap& places, std::uint16_t place, const types::Vector2& p_map) {
  const types::Rectangle& box = places.places[place - 1U].box;
  const types::Vector2 p = CompassFrame(places.compass_rad).from_map(p_map);
  const std::array<double, 4> away = {box.max.x() - p.x(), box.max.y() - p.y(), p.x() - box.min.x(),
                                      p.y() - box.min.y()};
  return static_cast<Side>(std::min_element(away.begin(), away.end()) - away.begin());
}

types::Vector2 side_midpoint(const places::PlaceMap& places, std::uint16_t place, Side side) {
  const types::Rectangle& box = places.places[place - 1U].box;
  types::Vector2 p = 0.5 * (box.min + box.max);
  if (side == Side::kEast) p.x() = box.max.x();
  if (side == Side::kNorth) p.y() = box.max.y();
  if (side == Side::kWest) p.x() = box.min.x();
  if (side == Side::kSouth) p.y() = box.min.y();
  return CompassFrame(places.compass_rad).to_map(p);
}

std::vector<Opening> find_openings(const GoalInput& input, const GoalParams& params) {
  std::vector<Opening> openings;
  for (Frontier& frontier : find_frontiers(input.map, params.opening_min_m)) {
    const std::uint32_t middle = middle_of(input.map, frontier.cells);
    const std::uint16_t place = place_of(input, middle, frontier);
    if (place == 0) continue;
    const Side side = nearest_side(input.places, place, input.map.centre_of(input.map.cell(middle)));
    openings.push_back({place, side, middle, frontier.width_m, std::move(frontier.cells)});
  }
  std::sort(openings.begin(), openings.end(), [](const Opening& a, const Opening& b) {
    return std::tie(a.place, a.side, a.middle) < std::tie(b.place, b.side, b.middle);
  });
  return openings;
}

}  // namespace topo::goals

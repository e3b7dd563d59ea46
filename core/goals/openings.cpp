// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/openings.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "core/goals/frontiers.hpp"
#include "core/places/box_counts.hpp"

namespace topo::goals {
namespace {

using places::CompassFrame;

double width_of(const grid::DenseMap& map, const std::vector<std::uint32_t>& cells) {
  grid::CellBox box;
  for (const std::uint32_t i : cells) box.extend(map.cell(i));
  return static_cast<double>(std::max(box.width(), box.height())) * map.resolution_m;
}

/// One frontier cell with what it belongs to.
struct SidedCell {
  std::uint16_t place;
  Side side;
  std::uint32_t cell;
};

/// Divides a frontier by place and side. What is too narrow alone goes to the frontier's widest part: an
/// opening must not be lost because it stands on the border between two places or at a corner of a box.
void divide(const GoalInput& input, const GoalParams& params, const Frontier& frontier,
            std::vector<SidedCell>& cells, std::vector<Opening>& out) {
  cells.clear();
  for (const std::uint32_t i : frontier.cells) {
    const std::uint16_t place = input.places.labels[i];
    if (place == 0) continue;
    const types::Vector2 p = input.map.centre_of(input.map.cell(i));
    cells.push_back({place, nearest_side(input.places, place, p), i});
  }
  std::stable_sort(cells.begin(), cells.end(), [](const SidedCell& a, const SidedCell& b) {
    return std::tie(a.place, a.side) < std::tie(b.place, b.side);
  });
  const std::size_t begin = out.size();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k == 0 || cells[k].place != cells[k - 1].place || cells[k].side != cells[k - 1].side)
      out.push_back({cells[k].place, cells[k].side, 0, 0.0, {}});
    out.back().cells.push_back(cells[k].cell);
  }
  if (begin == out.size()) return;
  for (std::size_t k = begin; k < out.size(); ++k) out[k].width_m = width_of(input.map, out[k].cells);
  const auto first = out.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto widest = std::max_element(
      first, out.end(), [](const Opening& a, const Opening& b) { return a.width_m < b.width_m; });
  std::iter_swap(first, widest);
  const auto narrow = [&](const Opening& o) { return o.width_m < params.opening_min_m - 1e-6; };
  for (auto it = first + 1; it != out.end(); ++it) {
    if (narrow(*it)) first->cells.insert(first->cells.end(), it->cells.begin(), it->cells.end());
  }
  out.erase(std::remove_if(first + 1, out.end(), narrow), out.end());
  first->width_m = width_of(input.map, first->cells);
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
  std::vector<SidedCell> cells;
  for (const Frontier& frontier : find_frontiers(input.map, params.opening_min_m))
    divide(input, params, frontier, cells, openings);
  for (Opening& opening : openings) opening.middle = middle_of(input.map, opening.cells);
  std::sort(openings.begin(), openings.end(), [](const Opening& a, const Opening& b) {
    return std::tie(a.place, a.side, a.middle) < std::tie(b.place, b.side, b.middle);
  });
  return openings;
}

}  // namespace topo::goals

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/segment_places.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/places/segmentation/box_counts.hpp"
#include "core/places/segmentation/corners.hpp"
#include "core/places/segmentation/first_labels.hpp"
#include "core/places/segmentation/piece_runs.hpp"
#include "core/places/segmentation/reduction.hpp"
#include "core/places/segmentation/regions.hpp"
#include "core/types/se2.hpp"

namespace topo::places {
namespace {

/// True for isolated free space that is too narrow to be anywhere in it: a gap in a wall, a strip seen
/// through a pane.
bool is_speck(const Region& region, const PlaceParams& params) {
  const bool isolated = std::none_of(region.contacts.begin(), region.contacts.end(),
                                     [](const Contact& c) { return c.upright + c.level != 0; });
  return isolated && 2.0 * static_cast<double>(region.clearance_m) < params.speck_width_m;
}

/// Turns the remaining regions into places, in the order of their lowest cells. Returns the number of each
/// region's place, 0 for specks.
std::vector<std::uint16_t> number_places(const std::vector<Region>& regions, double resolution_m,
                                         const PlaceParams& params, PlaceMap& out) {
  const double cell_m2 = resolution_m * resolution_m;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    if (regions[r].cells != 0 && !is_speck(regions[r], params)) kept.push_back(r);
  }
  std::sort(kept.begin(), kept.end(),
            [&](std::uint32_t a, std::uint32_t b) { return regions[a].first < regions[b].first; });
  if (kept.size() >= UINT16_MAX) kept.resize(UINT16_MAX - 1);
  std::vector<std::uint16_t> numbers(regions.size(), 0);
  for (const std::uint32_t r : kept) {
    const Region& region = regions[r];
    out.places.push_back({region.box, region.sum / region.cells, region.cells * cell_m2, region.clearance_m});
    numbers[r] = static_cast<std::uint16_t>(out.places.size());
  }
  return numbers;
}

void add_borders(const std::vector<Region>& regions, std::span<const std::uint16_t> numbers,
                 double resolution_m, PlaceMap& out) {
  for (std::size_t r = 0; r < regions.size(); ++r) {
    for (const Contact& c : regions[r].contacts) {
      if (numbers[r] == 0 || numbers[c.other] <= numbers[r] || c.upright + c.level == 0) continue;
      out.borders.push_back({static_cast<std::uint16_t>(numbers[r] - 1),
                             static_cast<std::uint16_t>(numbers[c.other] - 1), c.border() * resolution_m});
    }
  }
  std::sort(out.borders.begin(), out.borders.end(),
            [](const PlaceBorder& l, const PlaceBorder& r) { return l.a != r.a ? l.a < r.a : l.b < r.b; });
}

}  // namespace

PlaceMap reduce_labels(const grid::DenseMap& map, std::span<const float> clearance_m,
                       const FirstLabels& first, std::span<const types::Segment> walls, double compass_rad,
                       const PlaceParams& params) {
  assert(clearance_m.size() == map.cells.size());
  PlaceMap out;
  // A quarter turn does not change the compass; the angle nearest to the map's axes keeps north up.
  out.compass_rad = types::within_quarter(compass_rad);
  const CompassFrame frame(out.compass_rad);
  const std::vector<Region> pieces = regions_of(map, clearance_m, first, walls, frame, params.wall_side);
  std::vector<Region> regions = pieces;
  std::vector<std::uint32_t> roots = reduce(regions, BoxCounts(map, frame), map.resolution_m, params);
  if (settle_corners(pieces, roots, map.resolution_m, params)) regions = joined(pieces, roots);
  const auto numbers = number_places(regions, map.resolution_m, params, out);
  add_borders(regions, numbers, map.resolution_m, out);
  for (std::size_t k = 0; k < first.runs.size(); ++k) {
    const std::uint16_t number = numbers[roots[first.run_pieces[k]]];
    if (number != 0) out.labels.append(first.runs[k].first, first.runs[k].end, number);
  }
  return out;
}

PlaceMap segment_places(const grid::DenseMap& map, std::span<const float> clearance_m,
                        const Skeleton& skeleton, std::span<const types::Segment> walls, double compass_rad,
                        const PlaceParams& params) {
  const FirstLabels first = first_labels(map, clearance_m, skeleton, params.first);
  return reduce_labels(map, clearance_m, first, walls, compass_rad, params);
}

}  // namespace topo::places

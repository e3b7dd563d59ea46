// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/compass/compass.hpp"
#include "core/compass/occupied_points.hpp"
#include "core/places/segmentation/box_counts.hpp"
#include "core/places/segmentation/furniture.hpp"
#include "core/places/segmentation/segment_places.hpp"
#include "core/walls/wall_extraction.hpp"
#include "tests/unit/core/places/drawn_map.hpp"

namespace topo::places {

/// All stages from a map to its places, as the analysis runs them.
inline PlaceMap places_of_building(const grid::DenseMap& map) {
  const PlaceParams params;
  const auto points = compass::occupied_points(map);
  const double compass_rad = compass::entropy_compass(points).angle_rad.value_or(0.0);
  const auto walls = walls::extract_walls(points, compass_rad);
  const grid::DenseMap open = without_furniture(map, walls, params.furniture_m);
  const auto open_m = grid::clearance_m(open, grid::Boundary::kOccupiedOrUnknown);
  PlaceMap places = segment_places(open, open_m, skeletonise(open, open_m), walls, compass_rad, params);
  places.labels = places.labels.on_free_cells(map);
  return places;
}

/// After the paper's figure 7 (a): a corridor with a turn, rooms of several sizes along it, one of them large
/// and in the middle. Walls of 0.2 m, doors of 0.9 m.
inline DrawnMap clean_building() {
  DrawnMap drawn(560, 460);
  drawn.room(20, 20, 540, 60).room(500, 20, 540, 440);                           // corridors of 2 m
  drawn.room(20, 64, 140, 180).room(144, 64, 330, 250).room(334, 64, 496, 180);  // above the lower corridor
  drawn.room(20, 184, 140, 300).room(334, 184, 496, 300).room(144, 254, 330, 440).room(334, 304, 496, 440);
  drawn.room(20, 304, 140, 440);
  drawn.free(494, 20, 540, 60);                                              // the corridors' corner
  drawn.free(70, 60, 88, 64).free(230, 60, 248, 64).free(400, 60, 418, 64);  // doors to the lower corridor
  drawn.free(496, 230, 500, 248).free(496, 360, 500, 378);                   // doors to the right one
  drawn.free(140, 200, 144, 218).free(140, 360, 144, 378).free(230, 250, 248, 254);
  return drawn;
}

/// After figure 7 (b): the same with two pieces of furniture in the room in the middle, shelves and boxes
/// against walls, door alcoves, and chairs.
inline DrawnMap cluttered_building() {
  DrawnMap drawn = clean_building();
  drawn.occupied(180, 110, 196, 122).occupied(260, 180, 272, 196);  // free-standing
  drawn.occupied(144, 64, 152, 110).occupied(322, 90, 330, 150).occupied(270, 242, 320, 250);
  drawn.occupied(20, 172, 60, 180).occupied(132, 70, 140, 100).occupied(334, 64, 380, 71);
  drawn.occupied(20, 20, 26, 44).occupied(300, 54, 360, 60).occupied(440, 20, 470, 25);
  drawn.occupied(534, 120, 540, 180).occupied(500, 300, 505, 330).occupied(334, 290, 370, 300);
  drawn.free(64, 17, 84, 20).free(540, 240, 543, 262);  // alcoves
  for (int k = 0; k < 6; ++k) {
    drawn.occupied(180 + 20 * k, 300, 183 + 20 * k, 303).occupied(180 + 20 * k, 330, 184 + 20 * k, 333);
    drawn.occupied(370 + 18 * k, 340, 373 + 18 * k, 344).occupied(40 + 14 * k, 350, 43 + 14 * k, 353);
  }
  return drawn;
}

/// For every place of `labels` (numbers from 1) the greatest share of intersection to union with one of
/// `others`, over the cells that have a label in both; with the place's cells.
inline std::vector<std::pair<double, std::size_t>> best_overlaps(const std::vector<std::uint16_t>& labels,
                                                                 const std::vector<std::uint16_t>& others) {
  std::map<std::uint16_t, std::size_t> of_a, of_b;
  std::map<std::pair<std::uint16_t, std::uint16_t>, std::size_t> shared;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == 0 || others[i] == 0) continue;
    ++of_a[labels[i]];
    ++of_b[others[i]];
    ++shared[{labels[i], others[i]}];
  }
  std::vector<std::pair<double, std::size_t>> best;
  for (const auto& [a, cells] : of_a) {
    double share = 0.0;
    for (const auto& [pair, both] : shared) {
      if (pair.first != a) continue;
      const auto all = static_cast<double>(cells + of_b[pair.second] - both);
      share = std::max(share, static_cast<double>(both) / all);
    }
    best.emplace_back(share, cells);
  }
  return best;
}

}  // namespace topo::places

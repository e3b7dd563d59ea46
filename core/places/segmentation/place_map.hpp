// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/places/segmentation/place_labels.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

struct PlaceParams {
  double furniture_m = 1.0;   ///< what stands free and is no longer than this divides nothing
  double density_min = 0.64;  ///< free share of a place's bounding box, for a merge (paper II-C, condition 1)
  double elsewhere_weight = 0.3;  ///< beside an occupied cell in that box, of one that is unknown or of
                                  ///< another place: what is not there yet speaks less against a merge
  double turned_weight = 0.5;     ///< the same of a box that does not lie in the compass frame
  double width_ratio_max = 1.8;   ///< of the clearances of two corridor pieces, for a merge
  double narrow_ratio = 0.58;     ///< a passage narrower than this share of the narrower side divides places
  double wider_power = 0.1;     ///< of the sides' ratio, by which that share grows: doors lead from corridors
                                ///< into what is wider
  double parallel_share = 0.5;  ///< of the sum of several passages' widths that counts as one passage
  double wall_share_max = 0.8;  ///< of wall to open border between two places, for a merge (condition 2)
  double piece_m = 1.0;         ///< of the axis, in the first labels
  double small_m2 = 2.0;        ///< smaller places go to the neighbour with the longest common border
  double speck_m2 = 0.3;        ///< free space of its own smaller than this is no place at all
};

struct Place {
  types::Rectangle box;  ///< of its free space, in the compass frame (map turned by -compass_rad)
  types::Vector2 centroid{0.0, 0.0};  ///< of its free space, in map
  double area_m2 = 0.0;
  float clearance_max_m = 0.0F;
};

/// Two places that touch.
struct PlaceBorder {
  std::uint16_t a = 0;  ///< indices of places, a < b
  std::uint16_t b = 0;
  double length_m = 0.0;
};

/// The free space divided into places (paper section II-C).
struct PlaceMap {
  double compass_rad = 0.0;  ///< of the boxes, within an eighth of a turn of the map's axes
  /// Index of the place + 1; 0 outside free space and in specks of it that nothing leads to.
  PlaceLabels labels;
  std::vector<Place> places;  ///< in the order of their first cells in the map
  std::vector<PlaceBorder> borders;
};

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/places/segmentation/place_labels.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

struct PlaceParams {
  double furniture_m = 1.0;       ///< isolated obstacles up to this length do not divide places
  double density_min = 0.64;      ///< least free share of a place's bounding box, for a merge (paper II-C,
                                  ///< condition 1)
  double elsewhere_weight = 0.3;  ///< weight in that box of an unknown cell or one of another place, relative
                                  ///< to an occupied one: space not yet explored is weaker evidence against a
                                  ///< merge
  double turned_weight = 0.5;     ///< the same in a box that is not aligned to the compass frame
  double width_ratio_max = 1.8;   ///< largest ratio of the clearances of two corridor pieces, for a merge
  double narrow_ratio = 0.58;     ///< a passage narrower than this share of the narrower side divides places
  double wider_power = 0.1;  ///< exponent of the ratio of the sides' clearances, by which that share grows:
                             ///< doors lead from corridors into wider spaces
  double parallel_share = 0.5;  ///< of the summed widths of several passages, counted as one passage
  double wall_share_max = 0.8;  ///< largest ratio of wall to open border between two places, for a merge
                                ///< (condition 2)
  double piece_m = 1.0;         ///< length of the pieces of the axis, in the first labels
  double small_m2 = 2.0;        ///< smaller places go to the neighbour with the longest common border
  double speck_m2 = 0.3;        ///< isolated free space smaller than this is no place
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
  double compass_rad = 0.0;  ///< frame of the boxes, within an eighth of a turn of the map's axes
  /// Index of the place + 1; 0 outside free space and in isolated specks.
  PlaceLabels labels;
  std::vector<Place> places;  ///< in the order of their first cells in the map
  std::vector<PlaceBorder> borders;
};

}  // namespace topo::places

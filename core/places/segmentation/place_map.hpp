// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/places/segmentation/place_labels.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

/// The over-segmentation with which the reduction begins (first_labels.hpp).
struct FirstLabelParams {
  double piece_m = 1.0;         ///< length of the pieces of the axis
  float passage_ratio = 1.08F;  ///< at a passage, clearance falls and rises again by this factor
};

/// How dense a place fills a bounding box (paper II-C, condition 1).
struct DensityParams {
  double min = 0.5;                ///< least free share of the box, for a merge
  double elsewhere_weight = 0.54;  ///< weight in the box of an unknown cell or one of another place, relative
                                   ///< to an occupied one: space not yet explored is weaker evidence against
                                   ///< a merge
  double turned_weight = 0.58;     ///< the same in a box that is not aligned to the compass frame
  double steps = 50.0;  ///< in which densities are compared: of 2 %, so that single cells do not decide
};

/// Which regions are corridors.
struct CorridorParams {
  double length_ratio = 2.4;  ///< a corridor is longer than this multiple of its width,
  double clearance_ratio =
      0.7;  ///< and its clearance is less than this share of it; a slice of a hall has more
  double alongside_ratio = 1.5;  ///< a border longer than this multiple of the width lies alongside
};

/// Corner pieces between corridors (corners.hpp).
struct CornerParams {
  double in_line_min = 0.6;       ///< least share of a piece's width in the strip of a corridor
  std::uint32_t spurs_ratio = 2;  ///< a piece with its spurs has at most this multiple of its own cells
};

/// How walls are walked along to find the labels on both sides (wall_sides.hpp).
struct WallSideParams {
  double step_m = 0.10;   ///< along the wall
  double reach_m = 0.40;  ///< across its thickness to the regions that it bounds
};

/// Chosen on the ten maps and fourteen partial maps that doc/results.md names.
struct PlaceParams {
  double furniture_m = 1.0;      ///< isolated obstacles up to this length do not divide places
  double width_ratio_max = 1.8;  ///< largest ratio of the clearances of two corridor pieces, for a merge
  double narrow_ratio = 0.57;    ///< a passage narrower than this share of the narrower side divides places
  double wider_power = 0.1;  ///< exponent of the ratio of the sides' clearances, by which that share grows:
                             ///< doors lead from corridors into wider spaces
  double parallel_share = 0.5;  ///< of the summed widths of several passages, counted as one passage
  double wall_share_max = 0.8;  ///< largest ratio of wall to open border between two places, for a merge
                                ///< (condition 2)
  double small_m2 = 3.0;        ///< smaller places go to the neighbour with the longest common border
  double speck_width_m = 0.4;   ///< isolated free space that is nowhere wider is no place
  FirstLabelParams first;
  DensityParams density;
  CorridorParams corridor;
  CornerParams corner;
  WallSideParams wall_side;
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

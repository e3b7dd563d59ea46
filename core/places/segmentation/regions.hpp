// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/box_counts.hpp"
#include "core/places/segmentation/first_labels.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

/// The border between two regions, seen from one of them.
struct Contact {
  std::uint32_t other = 0;
  std::uint32_t upright = 0;  ///< pairs of cells side by side across the border
  std::uint32_t level = 0;    ///< pairs of cells one above the other
  float wall_m = 0.0F;        ///< length of wall between the two
  float clearance_m = 0.0F;   ///< largest minimum over the paths between the clearest points of both
  float open = 0.0F;          ///< width in cells of the border, or of the passage to it where that is less

  /// Length of the open border, in cells; a slanted border is a staircase of both kinds.
  [[nodiscard]] double border() const {
    return std::hypot(static_cast<double>(upright), static_cast<double>(level));
  }
};

/// Number of frames besides the compass frame, for parts at an angle to it: a quarter turn has six frames.
inline constexpr std::size_t kTurns = 5;

/// Free space with one label, and the data that the reduction needs.
struct Region {
  types::Rectangle box;   ///< of its cells, in the compass frame
  types::Rectangle core;  ///< the same for the clear discs along its axis: without nooks
  std::array<types::Rectangle, kTurns> turned;  ///< the core in frames turned by a further 15 degrees each
  types::Vector2 sum{0.0, 0.0};                 ///< of its cells' centres in map
  std::uint32_t cells = 0;                      ///< 0: merged into another region
  std::uint32_t first = UINT32_MAX;             ///< its lowest cell
  float clearance_m = 0.0F;                     ///< largest of its cells
  float straddled_m = 0.0F;                     ///< length of wall with the region on both sides: an opening
  std::uint32_t version = 0;                    ///< counts the merges
  std::vector<Contact> contacts;
};

/// The regions of first labels, in the order of the pieces, with their contacts; walls as in segment_places.
std::vector<Region> regions_of(const grid::DenseMap& map, std::span<const float> clearance_m,
                               const FirstLabels& first, std::span<const types::Segment> walls,
                               const CompassFrame& frame, const WallSideParams& params);

/// Merges region `from` into region `into`, whose core grows only when `grows_core`: by a region of equal
/// rank.
void absorb(std::vector<Region>& regions, std::uint32_t into, std::uint32_t from, bool grows_core);

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/box_counts.hpp"
#include "core/places/segmentation/first_labels.hpp"
#include "core/places/segmentation/wall_sides.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

/// What lies between one region and another.
struct Contact {
  std::uint32_t other = 0;
  std::uint32_t upright = 0;  ///< pairs of cells side by side across the border
  std::uint32_t level = 0;    ///< pairs of cells one above the other
  float wall_m = 0.0F;        ///< length of wall with one of them on each side
  float clearance_m = 0.0F;   ///< at the narrowest of the clearest way between the clearest points of both
  float open = 0.0F;          ///< width of the border in cells, or of what leads to it where that is less

  /// Of the open border, in cells; a slanted one is a staircase of both kinds.
  [[nodiscard]] double border() const {
    return std::hypot(static_cast<double>(upright), static_cast<double>(level));
  }
};

/// Frames beside that of the compass, for what is built at an angle to it: a quarter turn has six.
inline constexpr std::size_t kTurns = 5;

/// Free space with one label, and all that the reduction must know of it.
struct Region {
  types::Rectangle box;   ///< of its cells, in the compass frame
  types::Rectangle core;  ///< the same of what the clear discs along its axis reach: without nooks
  std::array<types::Rectangle, kTurns> turned;  ///< the core's in frames turned by 15 degrees more each
  types::Vector2 sum{0.0, 0.0};                 ///< of its cells' centres in map
  std::uint32_t cells = 0;                      ///< 0: gone into another region
  std::uint32_t first = UINT32_MAX;             ///< its lowest cell
  float clearance_m = 0.0F;                     ///< at its clearest
  float straddled_m = 0.0F;                     ///< length of wall with the region on both sides: an opening
  std::uint32_t version = 0;                    ///< counts the merges
  std::vector<Contact> contacts;
};

/// The regions of first labels, and what they leave to those of the next. A value; empty: of no map.
struct RegionMemory {
  std::optional<CompassFrame> frame;
  std::vector<std::uint32_t> pieces;  ///< as in FirstLabels
  std::vector<Region> regions;
  WallSides walls;
};

/// Makes of the regions those of these first labels, in the order of the pieces, with their contacts; walls
/// as in segment_places. `memory`: of those labels that these were made of, if they have a change; then it
/// costs the pieces with one, and a pass over all.
void renew_regions(const grid::DenseMap& map, std::span<const float> clearance_m, const FirstLabels& first,
                   std::span<const types::Segment> walls, const CompassFrame& frame, RegionMemory& memory);

/// Moves everything of region `from` to region `into`, whose core only grows by a part of equal rank.
void absorb(std::vector<Region>& regions, std::uint32_t into, std::uint32_t from, bool grows_core);

}  // namespace topo::places

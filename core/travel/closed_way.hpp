// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/grid/wavefront.hpp"
#include "core/types/keyframe_pose.hpp"

namespace topo::travel {

/// Where a map closes a way.
struct ClosedWay {
  types::Vector2 look_from{0.0, 0.0};  ///< position on the way, in reach, from which the obstacle is in sight
  types::Vector2 closed_at{0.0, 0.0};  ///< first position behind it that is out of reach
};

/// The obstacle that keeps a robot from the beginning of a way that ends at it, or did: the first of the
/// way's positions in map that the field reaches, and the one before it. Nothing when the beginning is in
/// reach, or none of the way is. `away_m`: from the obstacle to `look_from`, where the way is long enough.
/// Cost: the positions of the way.
std::optional<ClosedWay> closed_way(const grid::DenseMap& map, const grid::TravelField& field,
                                    std::span<const types::Vector2> way, double away_m);

/// The positions of a driven way, in map, since the robot was last carried or lost: since two keyframes that
/// are more than `gap_m` apart.
std::vector<types::Vector2> positions_of(std::span<const types::KeyframePose> way, double gap_m);

}  // namespace topo::travel

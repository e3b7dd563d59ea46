// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// Directions of a building's walls in map, modulo a quarter turn: of its wings, that with most keyframes
/// first. Empty where too few walls share any: nothing is said of headings in a round or a crooked building.
[[nodiscard]] std::vector<double> building_directions(std::span<const KeyframePtr> keyframes,
                                                      std::span<const types::Se2> poses,
                                                      const HeadingEvidenceParams& params);

/// A keyframe's walls against those of the building.
struct WallsAgainst {
  std::size_t wing = 0;  ///< whose direction is the nearest
  double off_rad = 0.0;  ///< how far the keyframe's are turned against it, in [-pi/4, pi/4]
};

/// Empty where either has none.
[[nodiscard]] std::optional<WallsAgainst> walls_against(const Keyframe& keyframe, const types::Se2& pose,
                                                        std::span<const double> building_rad);

/// A keyframe's heading in map by its walls.
struct Heading {
  std::size_t node = 0;
  double theta_rad = 0.0;  ///< the one of four that is nearest to the pose's
};

/// Headings of the keyframes whose walls have the direction that most have. A part of a building that is
/// askew by less than HeadingEvidenceParams::wing_rad counts as drift. Walls that are further off than
/// HeadingEvidenceParams::wing_rad say nothing: they may belong to a skew wing.
[[nodiscard]] std::vector<Heading> heading_evidence(std::span<const KeyframePtr> keyframes,
                                                    std::span<const types::Se2> poses,
                                                    const HeadingEvidenceParams& params);

/// A graph with one more node, the last: the building's axes. From it an edge with the closures' loss leads
/// to each heading, which says nothing of the position, and one to `fixed`, which says nothing else. With
/// that node held and `fixed` free, the solution depends on how the keyframes are turned against each other,
/// not on the direction that the building was thought to have.
struct CompassGraph {
  std::vector<types::Se2> poses;
  std::vector<Edge> edges;
};

[[nodiscard]] CompassGraph with_compass(std::span<const types::Se2> poses, std::span<const Edge> edges,
                                        std::span<const Heading> headings, std::size_t fixed,
                                        const HeadingEvidenceParams& params);

}  // namespace topo::slam

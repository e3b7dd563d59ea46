// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "core/slam/relation_set.hpp"

namespace topo::slam {

/// How well people put robots down where they say: standard deviations.
struct StartNoise {
  double trans_m = 0.10;
  double rot_rad = 0.05;
};

/// What ties two robots' first keyframes when it is known where they start, in one frame. The same relation
/// whichever of the two says it. Robust: robots that were put down elsewhere do not bend the map.
[[nodiscard]] std::pair<RelationKey, Relation> known_starts(const KeyframeId& a, const types::Se2& start_a,
                                                            const KeyframeId& b, const types::Se2& start_b,
                                                            const StartNoise& noise = {});

}  // namespace topo::slam

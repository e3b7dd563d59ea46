// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "core/slam/relation_set.hpp"

namespace topo::slam {

/// How accurately robots are placed at their given starts: standard deviations.
struct StartNoise {
  double trans_m = 0.10;
  double rot_rad = 0.05;
};

/// The relation between the first keyframes of two robots with known starts in one frame. It is the same for
/// both robots. Robust: robots that were placed elsewhere do not distort the map.
[[nodiscard]] std::pair<RelationKey, Relation> known_starts(const KeyframeId& a, const types::Se2& start_a,
                                                            const KeyframeId& b, const types::Se2& start_b,
                                                            const StartNoise& noise = {});

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"

namespace topo::slam {

/// Creates an immutable keyframe from a deskewed scan and the heights seen since the keyframe before, rounded
/// as by the codec: a loaded session gives a map that is bit-identical to the live one. `match_points` are
/// those selected from the cloud.
[[nodiscard]] KeyframePtr make_keyframe(KeyframeId id, const Cloud& cloud,
                                        std::span<const Point> match_points, const types::Se2& T_odom_base,
                                        std::vector<walls::ColumnPoint> columns, const CloudParams& params);

}  // namespace topo::slam

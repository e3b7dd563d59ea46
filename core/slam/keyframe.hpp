// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "core/slam/cloud.hpp"
#include "core/slam/keyframe_content.hpp"
#include "core/slam/keyframe_id.hpp"

namespace topo::slam {

/// The complete contribution of one pose of the path to the map, immutable: nothing else enters the map. All
/// in base_link at `stamp`.
struct Keyframe {
  KeyframeId id;
  types::Stamp stamp{};
  types::Se2 T_odom_base;  ///< dead reckoning at `stamp`
  Point sensor = Point::Zero();
  CodedContent content;
  std::optional<double> walls_rad;  ///< wall_direction of the surfels: neither sent nor stored
};

using KeyframePtr = std::shared_ptr<const Keyframe>;

}  // namespace topo::slam

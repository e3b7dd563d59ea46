// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include "core/slam/cloud.hpp"
#include "core/walls/height_column.hpp"

namespace topo::slam {

/// The source of keyframes: a robot in one run of its program. A robot that restarts its count has another
/// run number, so that no key occurs in two runs.
struct Origin {
  std::uint16_t robot = 0;
  std::uint32_t run = 0;
  friend auto operator<=>(const Origin&, const Origin&) = default;
};

/// The origin of a keyframe and its number there: the key of the grow-only set (DESIGN "Team"). Ordered by
/// robot, run and sequence.
struct KeyframeId {
  std::uint16_t robot = 0;
  std::uint32_t sequence = 0;
  std::uint32_t run = 0;
  [[nodiscard]] Origin origin() const { return {robot, run}; }
  friend bool operator==(const KeyframeId&, const KeyframeId&) = default;
  friend auto operator<=>(const KeyframeId& a, const KeyframeId& b) {
    return std::tie(a.robot, a.run, a.sequence) <=> std::tie(b.robot, b.run, b.sequence);
  }
};

/// The complete contribution of one pose of the path to the map, immutable: nothing else enters the map. All
/// in base_link at `stamp`.
struct Keyframe {
  KeyframeId id;
  types::Stamp stamp{};
  types::Se2 T_odom_base;  ///< dead reckoning at `stamp`
  Point sensor = Point::Zero();
  std::vector<Point> hits;                  ///< ends of the rays
  std::vector<Surfel> surfels;              ///< for matching other scans against this keyframe
  std::vector<Point> match_points;          ///< for matching this keyframe against others
  std::vector<walls::ColumnPoint> columns;  ///< seen by the coronal laser since the keyframe before
};

using KeyframePtr = std::shared_ptr<const Keyframe>;

}  // namespace topo::slam

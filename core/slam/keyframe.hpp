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

/// Who makes keyframes: a robot in one run of its program. A robot that begins to count anew has another run
/// number, so that nothing of two runs has one key.
struct Origin {
  std::uint16_t robot = 0;
  std::uint32_t run = 0;
  friend auto operator<=>(const Origin&, const Origin&) = default;
};

/// Who made a keyframe and as which of his: the key of the grow-only set (DESIGN "Team"). Ordered by robot,
/// run and sequence.
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

/// Everything that a place of the path adds to the map, frozen: nothing else enters the map. All in base_link
/// at `stamp`.
struct Keyframe {
  KeyframeId id;
  types::Stamp stamp{};
  types::Se2 T_odom_base;  ///< dead reckoning at `stamp`
  Point sensor = Point::Zero();
  std::vector<Point> hits;                  ///< ends of the rays
  std::vector<Surfel> surfels;              ///< for others to be matched against
  std::vector<Point> match_points;          ///< to be matched against others
  std::vector<walls::ColumnPoint> columns;  ///< what the coronal laser saw since the keyframe before
};

using KeyframePtr = std::shared_ptr<const Keyframe>;

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/surfel_map.hpp"

namespace topo::slam {

/// Ground that rays of a map's keyframes passed over: what a scan shows there contradicts the map, while what
/// it shows where nobody has looked says nothing.
class FreeGround {
 public:
  /// A square window, lower left corner and width.
  FreeGround(const Point& origin, double width_m);

  /// A ray up to shortly before where it ended.
  void add_ray(const Point& from, const Point& to);

  /// Share of the points (base_link) that, at the pose, are on free ground with no surface near.
  [[nodiscard]] double contradiction(const SurfelMap& map, std::span<const Point> points,
                                     const types::Se2& T_map_base) const;

 private:
  /// Place of a point's cell; the number of cells when it is outside.
  [[nodiscard]] std::size_t at(const Point& p) const;
  Point origin_;
  std::size_t side_;
  std::vector<std::uint8_t> passed_;  ///< how many rays, up to 255
};

/// What keyframes at their poses saw through, in the window of a map.
FreeGround seen_through(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                        const SurfelMap& map);

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/surfel_map.hpp"

namespace topo::slam {

/// Ground crossed by the rays of a map's keyframes. A scan point there contradicts the map; a scan point on
/// unobserved ground carries no evidence.
class FreeGround {
 public:
  /// A square window, given by its lower left corner and width.
  FreeGround(const Point& origin, double width_m, const FreeGroundParams& params);

  /// Marks a ray up to a short distance before its end.
  void add_ray(const Point& from, const Point& to);

  /// Share of the points (base_link) that, at the pose, lie on free ground with no surface near.
  [[nodiscard]] double contradiction(const SurfelMap& map, std::span<const Point> points,
                                     const types::Se2& T_map_base) const;

  /// True when enough rays crossed the ground at a point of the map: what stood there once is gone.
  [[nodiscard]] bool is_crossed(const Point& p_map) const;

 private:
  /// Index of a point's cell; the number of cells when the point is outside.
  [[nodiscard]] std::size_t at(const Point& p) const;
  FreeGroundParams params_;
  Point origin_;
  std::size_t side_;
  std::vector<std::uint8_t> passed_;  ///< number of rays, up to 255
};

/// The ground crossed by the rays of keyframes at their poses, within the window of a map.
FreeGround seen_through(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                        const SurfelMap& map, const FreeGroundParams& params);

}  // namespace topo::slam

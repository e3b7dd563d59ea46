// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/map_correction.hpp"

#include <algorithm>

namespace topo::types {

const Se2& MapCorrection::around(const Vector2& p_map) const {
  const auto nearest = std::ranges::min_element(
      keyframes_, {}, [&](const Moved& keyframe) { return (keyframe.before - p_map).squaredNorm(); });
  return nearest->change;
}

std::optional<MapCorrection> MapAnchors::take(std::span<const KeyframePose> keyframes, double by_m,
                                              double by_rad) {
  const std::size_t count = placed_.size();
  bool is_known = count > 0 && count <= keyframes.size();
  bool is_bent = false;
  for (std::size_t i = 0; is_known && i < count; ++i) {
    is_known = keyframes[i].stamp == placed_[i].stamp;
    const Se2 before = placed_[i].T_map_base.se2(), now = keyframes[i].T_map_base.se2();
    is_bent = is_bent || is_apart(before, now, by_m, by_rad);
  }
  if (is_known && !is_bent) {
    placed_.insert(placed_.end(), keyframes.begin() + static_cast<std::ptrdiff_t>(count), keyframes.end());
    return std::nullopt;
  }
  std::optional<MapCorrection> correction;
  if (is_known) {
    correction.emplace();
    for (std::size_t i = 0; i < count; ++i) {
      const Se2 before = placed_[i].T_map_base.se2();
      correction->keyframes_.push_back(
          {before.translation(), keyframes[i].T_map_base.se2() * before.inverse()});
    }
  }
  placed_.assign(keyframes.begin(), keyframes.end());
  return correction;
}

}  // namespace topo::types

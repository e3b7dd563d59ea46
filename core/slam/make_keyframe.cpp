// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/make_keyframe.hpp"

#include <utility>

#include "core/slam/wall_direction.hpp"

namespace topo::slam {

KeyframePtr make_keyframe(KeyframeId id, const Cloud& cloud, std::span<const Point> match_points,
                          const types::Se2& T_odom_base, std::vector<walls::ColumnPoint> columns,
                          const CloudParams& params) {
  auto keyframe = std::make_shared<Keyframe>();
  keyframe->id = id;
  keyframe->stamp = cloud.stamp;
  keyframe->T_odom_base = T_odom_base;
  keyframe->sensor = cloud.sensor;
  keyframe->content = CodedContent({cloud.points,
                                    make_surfels(cloud, params),
                                    {match_points.begin(), match_points.end()},
                                    std::move(columns)});
  keyframe->walls_rad = wall_direction(keyframe->content.surfels());
  return keyframe;
}

}  // namespace topo::slam

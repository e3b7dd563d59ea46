// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/heading_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/slam/wall_direction.hpp"

namespace topo::slam {

std::vector<double> building_directions(std::span<const KeyframePtr> keyframes,
                                        std::span<const types::Se2> poses,
                                        const HeadingEvidenceParams& params) {
  std::vector<double> walls_rad;
  walls_rad.reserve(keyframes.size());
  for (std::size_t node = 0; node < keyframes.size(); ++node) {
    if (keyframes[node]->walls_rad) walls_rad.push_back(poses[node].theta_rad + *keyframes[node]->walls_rad);
  }
  const auto all = static_cast<double>(walls_rad.size());
  std::vector<CommonDirection> wings;
  double of_a_wing = 0.0;
  while (!walls_rad.empty()) {
    const CommonDirection wing = common_direction(walls_rad, params.near_rad);
    if (static_cast<double>(wing.near) < params.wing_share_min * all) break;
    wings.push_back(wing);
    of_a_wing += static_cast<double>(wing.near);
    // A wing less than two gates away is the same one, turned by what drift there is.
    std::erase_if(walls_rad, [&](double walls) {
      return std::abs(types::within_quarter(walls - wing.angle_rad)) <= 2.0 * params.wing_rad;
    });
  }
  if (of_a_wing < params.share_min * all) return {};
  std::ranges::stable_sort(wings, std::greater<>{}, &CommonDirection::near);
  std::vector<double> wings_rad;
  wings_rad.reserve(wings.size());
  for (const CommonDirection& wing : wings) wings_rad.push_back(wing.angle_rad);
  return wings_rad;
}

std::optional<WallsAgainst> walls_against(const Keyframe& keyframe, const types::Se2& pose,
                                          std::span<const double> building_rad) {
  if (!keyframe.walls_rad || building_rad.empty()) return std::nullopt;
  WallsAgainst nearest;
  for (std::size_t wing = 0; wing < building_rad.size(); ++wing) {
    const double off_rad = types::within_quarter(pose.theta_rad + *keyframe.walls_rad - building_rad[wing]);
    if (wing == 0 || std::abs(off_rad) < std::abs(nearest.off_rad)) nearest = {wing, off_rad};
  }
  return nearest;
}

std::vector<Heading> heading_evidence(std::span<const KeyframePtr> keyframes,
                                      std::span<const types::Se2> poses,
                                      const HeadingEvidenceParams& params) {
  std::vector<Heading> headings;
  const std::vector<double> building_rad = building_directions(keyframes, poses, params);
  for (std::size_t node = 0; node < keyframes.size(); ++node) {
    const auto walls = walls_against(*keyframes[node], poses[node], building_rad);
    if (!walls || walls->wing != 0 || std::abs(walls->off_rad) > params.wing_rad) continue;
    headings.push_back({node, types::wrap_angle(poses[node].theta_rad - walls->off_rad)});
  }
  return headings;
}

CompassGraph with_compass(std::span<const types::Se2> poses, std::span<const Edge> edges,
                          std::span<const Heading> headings, std::size_t fixed,
                          const HeadingEvidenceParams& params) {
  CompassGraph graph{{poses.begin(), poses.end()}, {edges.begin(), edges.end()}};
  const std::size_t axes = poses.size();
  graph.poses.push_back({poses[fixed].x_m, poses[fixed].y_m, 0.0});
  graph.edges.reserve(edges.size() + headings.size() + 1);
  Edge place;
  place.from = axes;
  place.to = fixed;
  place.information = Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal();
  graph.edges.push_back(place);
  for (const Heading& heading : headings) {
    Edge edge;
    edge.from = axes;
    edge.to = heading.node;
    edge.T_from_to.theta_rad = heading.theta_rad;
    edge.information = Eigen::Vector3d(0.0, 0.0, 1.0 / (params.sigma_rad * params.sigma_rad)).asDiagonal();
    edge.robust = true;
    graph.edges.push_back(edge);
  }
  return graph;
}

}  // namespace topo::slam

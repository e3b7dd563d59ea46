// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <vector>

#include "core/slam/cloud.hpp"
#include "core/slam/mapper.hpp"
#include "core/slam/surfel_map.hpp"
#include "tests/mocks/flat_world.hpp"

namespace topo::slam::testing {

/// A scan of a world from a pose, as cloud, points and surfels.
struct View {
  Cloud cloud;
  std::vector<Point> points;
  std::vector<Surfel> surfels;
};

inline View view_of(const mocks::FlatWorld& world, const types::Se2& pose, double sigma_m,
                    std::mt19937& random) {
  const CloudParams params;
  View view;
  make_cloud(mocks::take_scan(world, pose, {}, {1081, 1.5 * std::numbers::pi, 30.0, sigma_m}, random), {}, {},
             params, view.cloud);
  select_points(view.cloud, params, view.points);
  view.surfels = make_surfels(view.cloud, params);
  return view;
}

/// Solves a mapper's graph at once when there is something new in it, as the loop closure thread does later.
inline void correct(Mapper& mapper) {
  if (const auto query = mapper.take_graph_query()) mapper.adopt(mapper.corrected(solve_graph(*query)));
}

/// Map of a world made of views from a few true poses.
inline SurfelMap map_of(const mocks::FlatWorld& world, const std::vector<types::Se2>& poses, double sigma_m,
                        std::mt19937& random) {
  SurfelMap map(0.35);
  map.reset(poses.front().translation().cast<float>(), 25.0);
  for (const types::Se2& pose : poses) map.add(view_of(world, pose, sigma_m, random).surfels, pose);
  return map;
}

}  // namespace topo::slam::testing

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/map_graph.hpp"

#include <gtest/gtest.h>

namespace topo::slam {
namespace {

constexpr std::size_t kLooseAt = 15;

/// Twenty keyframes, one every 0.4 m; the edge to the fifteenth has this standard deviation of its rotation.
MapGraph path(double loose_rad) {
  MapGraph graph(0, {}, {});
  for (std::uint32_t i = 0; i < 20; ++i) {
    auto keyframe = std::make_shared<Keyframe>();
    keyframe->id = {0, i, 0};
    graph.add_own(keyframe, {0.4 * i, 0.0, 0.0});
    if (i == 0) continue;
    const double sigma_rad = i == kLooseAt ? loose_rad : 0.003;
    Edge edge{i - 1, i, {0.4, 0.0, 0.0}};
    edge.information = Eigen::Vector3d(1000.0, 1000.0, 1.0 / (sigma_rad * sigma_rad)).asDiagonal();
    graph.add(edge);
  }
  return graph;
}

std::size_t end_of_past(const MapGraph& graph, std::size_t place) {
  return graph.end_of_past(place, graph.distances_m(place), {});
}

TEST(MapGraph, WhatLiesBeforeALooseEdgeIsAnotherVisit) {
  const MapGraph graph = path(0.08);
  EXPECT_EQ(end_of_past(graph, 19), kLooseAt);
  EXPECT_EQ(end_of_past(graph, kLooseAt), kLooseAt);
  EXPECT_EQ(end_of_past(graph, kLooseAt - 1), 0U) << "the loose edge is yet to come";
  EXPECT_EQ(end_of_past(path(0.003), 19), 0U) << "matches are certain";
}

/// As when a session is loaded.
TEST(MapGraph, ALooseEdgeIsKnownWheneverItComes) {
  const MapGraph live = path(0.08);
  MapGraph loaded(0, {}, {});
  for (std::size_t i = 0; i < live.keyframes().size(); ++i)
    loaded.add_own(live.keyframes()[i], live.poses()[i]);
  for (const Edge& edge : live.edges()) loaded.add(edge);
  EXPECT_EQ(end_of_past(loaded, 19), kLooseAt);
}

TEST(MapGraph, ALooseEdgeIsAsLongAsItDrifts) {
  const LoopParams params;
  const MapGraph graph = path(0.08);
  const std::vector<double> distances_m = graph.distances_m(19);
  EXPECT_NEAR(distances_m[0] * params.drift_per_m_rad, 0.08 + 7.6 * params.drift_per_m_rad, 0.005);
  EXPECT_LT(distances_m[kLooseAt], 3.0);
}

TEST(MapGraph, AClosureAcrossALooseEdgeEndsTheSearch) {
  MapGraph graph = path(0.08);
  Edge closure{10, 17, {2.8, 0.0, 0.0}};
  closure.information *= 1000.0;
  closure.robust = true;
  graph.add(closure);
  EXPECT_EQ(end_of_past(graph, 19), 0U);
}

}  // namespace
}  // namespace topo::slam

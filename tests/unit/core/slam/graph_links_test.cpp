// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_links.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace topo::slam {
namespace {

Edge edge(std::size_t from, std::size_t to, double length_m) {
  Edge out;
  out.from = from;
  out.to = to;
  out.T_from_to = {length_m, 0.0, 0.0};
  return out;
}

TEST(GraphLinks, TakesTheShorterWayEitherWayRound) {
  GraphLinks links;
  for (const Edge& e : {edge(0, 1, 3.0), edge(1, 2, 3.0), edge(2, 3, 3.0)}) links.add(e);
  EXPECT_NEAR(links.distances_m(4, 3)[0], 9.0, 0.2);
  links.add(edge(3, 0, 1.0));
  EXPECT_NEAR(links.distances_m(4, 3)[0], 1.0, 0.1);
  EXPECT_NEAR(links.distances_m(4, 0)[3], 1.0, 0.1);
  EXPECT_NEAR(links.distances_m(4, 0)[2], 4.0, 0.2);
}

TEST(GraphLinks, NoWayLeadsToWhatNothingTies) {
  GraphLinks links;
  links.add(edge(0, 1, 1.0));
  const auto distances_m = links.distances_m(4, 0);
  ASSERT_EQ(distances_m.size(), 4U);
  EXPECT_EQ(distances_m[3], HUGE_VAL);
  EXPECT_EQ(links.distances_m(4, 3)[0], HUGE_VAL);
  EXPECT_EQ(links.distances_m(4, 3)[3], 0.0);
}

}  // namespace
}  // namespace topo::slam

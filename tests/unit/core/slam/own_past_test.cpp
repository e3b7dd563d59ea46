// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/own_past.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/slam/team_alignment.hpp"
#include "tests/unit/core/slam/team_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// Without closures across loose edges, which would find the robot first.
MapperParams past_alone() {
  MapperParams params;
  params.graph.loose_rad = HUGE_VAL;
  return params;
}

/// A robot that goes once round a ring of corridors and on. From one corner to the middle of the next
/// corridor it sees nothing, and its odometry misses a turn of `missed_rad` there.
struct Round {
  explicit Round(double missed_rad, const MapperParams& params = past_alone()) : mapper(params) {
    const auto way = testing::legs(
        {{1.2, 1.2}, {22.8, 1.2}, {22.8, 16.8}, {1.2, 16.8}, {1.2, 1.2}, {22.8, 1.2}, {22.8, 14.0}});
    const mocks::FlatWorld world = mocks::ring_corridor();
    walls::ColumnCollector columns({});
    std::mt19937 random(4);
    Se2 odometry;
    bool blind = false, was_blind = false;
    for (std::size_t i = 0; i < way.size(); ++i) {
      const Se2& pose = way[i];
      was_blind = blind;
      blind = i < way.size() / 2 && pose.x_m > 12.0 && pose.y_m > 14.0;
      if (i > 0) odometry = odometry * (way[i - 1].inverse() * pose);
      if (was_blind && !blind) odometry = odometry * Se2{0.0, 0.0, missed_rad};
      testing::View view = testing::view_of(world, pose, 0.01, random);
      if (blind) view.cloud = {};
      view.cloud.stamp = types::stamp_from_seconds(0.2 * static_cast<double>(i + 1));
      (void)mapper.add(view.cloud, odometry, columns);
      if (const auto query = mapper.take_query()) (void)mapper.apply(find_closures(*query));
      if (const auto query = mapper.take_alignment_query()) take(align_maps(*query));
      testing::correct(mapper);
      off_m = (mapper.T_map_base().translation() - (way.front().inverse() * pose).translation()).norm();
    }
  }
  void take(const Alignment& alignment) {
    ++asked;
    if (!alignment.found()) return;
    ++found;
    for (const auto& [key, relation] : alignment.closures) (void)mapper.relate(key, relation);
  }

  Mapper mapper;
  int asked = 0, found = 0;
  double off_m = 0.0;  ///< of the last pose from the truth
};

TEST(OwnPast, ARobotLedAstrayIsFoundInItsOwnMapAndTheMapMended) {
  const Round round(0.4);
  EXPECT_GE(round.found, 1);
  EXPECT_LT(round.off_m, 0.3);
}

TEST(OwnPast, WithoutItTheMapStaysBent) {
  MapperParams params = past_alone();
  params.past.past_min = 100'000;
  const Round round(0.4, params);
  EXPECT_EQ(round.asked, 0);
  EXPECT_GT(round.off_m, 2.0);
}

TEST(OwnPast, ASoundRobotIsNotSearchedFor) {
  const Round round(0.0);
  EXPECT_LT(round.off_m, 0.3);
  EXPECT_EQ(round.found, 0) << "closures near the estimate did it";
}

/// A path along x, every metre a keyframe, with edges of one uncertainty.
MapGraph straight_path(std::size_t count, double sigma_m, double sigma_rad) {
  MapGraph graph(0, {}, {});
  for (std::size_t i = 0; i < count; ++i) {
    auto keyframe = std::make_shared<Keyframe>();
    keyframe->id = {0, static_cast<std::uint32_t>(i), 0};
    graph.add_own(keyframe, {static_cast<double>(i), 0.0, 0.0});
    if (i == 0) continue;
    Edge edge{i - 1, i, {1.0, 0.0, 0.0}, {}, false};
    edge.information =
        Eigen::Vector3d(1.0 / (sigma_m * sigma_m), 1.0 / (sigma_m * sigma_m), 1.0 / (sigma_rad * sigma_rad))
            .asDiagonal();
    graph.add(edge);
  }
  return graph;
}

TEST(OwnPast, TheWaySinceTheLastClosureBoundsWhereThePastIsBelieved) {
  const OwnPastParams past;
  MapGraph graph = straight_path(200, 0.01, 0.02);
  const auto query = OwnPast(past).take(graph, {});
  ASSERT_TRUE(query);
  double square_m2 = 0.0;
  for (int lever = 0; lever < 199; ++lever) square_m2 += 2e-4 + 4e-4 * lever * lever;
  EXPECT_NEAR(query->gate.off_max_m, past.sigmas * std::sqrt(square_m2), 1e-6);
  EXPECT_NEAR(query->gate.off_max_rad, past.sigmas * 0.02 * std::sqrt(199.0), 1e-9);
  EXPECT_EQ(query->mates.keyframes.size(), past.window);
  EXPECT_EQ(query->mates.keyframes.back()->id.sequence, 199U);
  EXPECT_EQ(query->own.keyframes.back()->id.sequence, 200U - past.window - 12U - 1U + 1U);
  Edge closure{0, 198, {198.0, 0.0, 0.0}, 1e3 * Eigen::Matrix3d::Identity(), true};
  graph.add(closure);
  EXPECT_FALSE(OwnPast(past).take(graph, {})) << "one edge is left that no closure spans";
}

TEST(OwnPast, IsAskedOnceInSoManyKeyframes) {
  OwnPast past{OwnPastParams{}};
  EXPECT_TRUE(past.take(straight_path(200, 0.01, 0.02), {}));
  EXPECT_FALSE(past.take(straight_path(220, 0.01, 0.02), {}));
  EXPECT_TRUE(past.take(straight_path(233, 0.01, 0.02), {}));
  EXPECT_FALSE(OwnPast(OwnPastParams{}).take(straight_path(100, 0.01, 0.02), {})) << "too short";
}

TEST(OwnPast, AMatchThatOdometryContradictsIsADoubtThatSearches) {
  const auto asks = [](double false_turn_rad) {
    MapGraph graph(0, {}, {});
    for (std::uint32_t i = 0; i < 200; ++i) {
      auto keyframe = std::make_shared<Keyframe>();
      keyframe->id = {0, i, 0};
      keyframe->stamp = types::stamp_from_seconds(i);
      keyframe->T_odom_base = {static_cast<double>(i), 0.0, 0.0};
      graph.add_own(keyframe, {static_cast<double>(i), 0.0, 0.0});
      if (i == 0) continue;
      Edge edge{i - 1, i, {1.0, 0.0, i == 100 ? false_turn_rad : 0.0}, {}, false};
      edge.information = Eigen::Vector3d(1e6, 1e6, 1e8).asDiagonal();
      graph.add(edge);
    }
    return OwnPast({}).take(graph, {});
  };
  EXPECT_FALSE(asks(0.0)) << "no drift to speak of";
  const auto query = asks(0.4);
  ASSERT_TRUE(query);
  EXPECT_NEAR(query->gate.off_max_rad, OwnPastParams{}.sigmas * 0.4, 0.01);
}

TEST(OwnPast, AnIdleRobotLooksBackOverItsWholeWayOnce) {
  const OwnPastParams params;
  const MapGraph graph = straight_path(300, 0.01, 0.02);
  OwnPast past(params);
  ASSERT_TRUE(past.take(graph, {}));
  std::vector<std::uint32_t> ends;
  while (const auto query = past.take_idle(graph, {})) {
    ends.push_back(query->mates.keyframes.back()->id.sequence);
    EXPECT_EQ(query->mates.keyframes.size(), params.window);
    EXPECT_LT(query->own.keyframes.back()->id.sequence, query->mates.keyframes.front()->id.sequence);
    ASSERT_LT(ends.size(), 100U);
  }
  EXPECT_EQ(ends, (std::vector<std::uint32_t>{266, 233, 200, 167, 134}));
  EXPECT_TRUE(past.take_idle(straight_path(301, 0.01, 0.02), {})) << "the newest stretch comes first";
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/team_start.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/sim/robot_model.hpp"

namespace topo::sim {
namespace {

World room(double width_m, double depth_m) {
  const std::string text = fmt::format(
      "name = \"room\"\n[[start]]\nx_m = 1.0\ny_m = 0.8\n[[wall]]\n"
      "points_m = [[0.0, 0.0], [{0}, 0.0], [{0}, {1}], [0.0, {1}]]\nclosed = true\nthickness_m = 0.2\n",
      width_m, depth_m);
  auto world = World::from_scene_text(text, "room.toml");
  EXPECT_TRUE(world.has_value()) << (world ? "" : world.error().message);
  return std::move(*world);
}

void expect_fit(const World& world, const std::vector<Se2>& starts) {
  const RobotModel model = RobotModel::p3dx();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_FALSE(world.touch(model.footprint(), starts[i], 0.0, 1.0).touching) << "robot " << i;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((starts[i].translation() - starts[j].translation()).norm(), 1.299);
  }
}

TEST(TeamStarts, areNearTheSpotWithRoomBetween) {
  const World world = room(9.0, 6.0);
  const Se2 spot{4.0, 3.0, 0.5};
  const auto starts = team_starts(world, spot, 5);
  ASSERT_TRUE(starts.has_value()) << starts.error().message;
  ASSERT_EQ(starts->size(), 5U);
  EXPECT_EQ(starts->front(), spot);
  expect_fit(world, *starts);
  for (const Se2& start : *starts) EXPECT_LE((start.translation() - spot.translation()).norm(), 1.9);
  EXPECT_LT((spot.inverse() * (*starts)[1]).x_m, -1.29) << "the second stands behind the first";
}

TEST(TeamStarts, areInALineInANarrowCorridor) {
  const World world = room(9.0, 1.6);
  const auto starts = team_starts(world, {1.0, 0.8, 0.0}, 3);
  ASSERT_TRUE(starts.has_value()) << starts.error().message;
  expect_fit(world, *starts);
  EXPECT_GT((*starts)[2].x_m, 3.3);
}

TEST(HasRoom, isAwayFromWalls) {
  const World world = room(9.0, 6.0);
  EXPECT_TRUE(has_room(world, {4.0, 3.0, 0.3}));
  EXPECT_FALSE(has_room(world, {4.0, 0.4, 0.0})) << "it fits, but could not turn to the wall and back";
  EXPECT_FALSE(has_room(world, {-1.0, 3.0, 0.0})) << "in no room at all";
}

TEST(TeamStarts, sayHowManyFoundRoom) {
  const auto starts = team_starts(room(2.4, 1.6), {1.0, 0.8, 0.0}, 4);
  ASSERT_FALSE(starts.has_value());
  EXPECT_NE(starts.error().message.find("expected 4"), std::string::npos) << starts.error().message;
  EXPECT_NE(starts.error().message.find("found room for"), std::string::npos);
}

}  // namespace
}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's stories of two robots, in lock-step with the simulated building: figure 8 (one goal, one robot
// goes and the other waits; at the junction both go) and figure 10 (a second robot that enters a minute later
// makes the mission shorter). Pictures go to the test's temporary folder.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/bench/topobench/explore/explore_report.hpp"
#include "tests/bench/topobench/explore/team_run.hpp"
#include "tests/bench/topobench/output.hpp"
#include "tests/sim/area.hpp"
#include "tests/sim/robot_model.hpp"

namespace topo::bench {
namespace {

/// A corridor 2.4 m wide that goes `east_m` from the start, turns north for `north_m` and ends in a cross
/// corridor with two arms. Robots look north, so that neither end is in their blind sector.
sim::World junction(double east_m, double north_m, double arm_m) {
  const std::string text = fmt::format(
      "name = \"junction\"\n[[start]]\nx_m = 2.5\ny_m = 0.0\ntheta_rad = 1.5708\n"
      "[[wall]]\nclosed = true\nthickness_m = 0.2\n"
      "points_m = [[0.0, -1.2], [{0}, -1.2], [{0}, {2}], [{4}, {2}], [{4}, {3}], [{5}, {3}], [{5}, {2}], "
      "[{1}, {2}], [{1}, 1.2], [0.0, 1.2]]\n",
      east_m, east_m - 2.4, north_m, north_m + 2.4, east_m + arm_m, east_m - 2.4 - arm_m);
  auto world = sim::World::from_scene_text(text, "junction.toml");
  EXPECT_TRUE(world.has_value()) << (world ? "" : world.error().message);
  return std::move(*world);
}

RunSetup setup_in(const sim::World& world) {
  RunSetup setup = default_setup(world.start_poses().front(), 1, Fidelity::kPlan);
  setup.limit_s = 900.0;
  return setup;
}

sim::Raster visible_area(const sim::World& world) {
  return reachable_area(world, world.start_poses().front().translation(),
                        sim::RobotModel::p3dx().swing_radius_m)
      .visible;
}

/// What a robot was about over time.
class Log final : public RunHooks {
 public:
  struct Entry {
    double t_s;
    pipeline::Activity activity;
    bool moving;
    std::string reason;
    types::Vector2 p_map;
  };
  void planned(const pipeline::PlanningOutput& output) override {
    const pipeline::PlanningReport& report = *output.report;
    entries.push_back({types::to_seconds(report.stamp), report.activity, output.plan.moving, report.reason,
                       report.T_map_base.se2().translation()});
  }
  std::vector<Entry> entries;
};

TEST(TeamStory, oneGoalSendsOneRobotAndTheJunctionTheOther) {  // figure 8
  const auto world = std::make_shared<sim::World>(junction(10.0, 14.0, 40.0));
  const sim::Raster visible = visible_area(*world);
  const TeamSetup setup{setup_in(*world), 2, {}, 0.0};
  std::array<Log, 2> logs;
  const std::array<RunHooks*, 2> hooks{&logs[0], &logs[1]};
  const auto result = run_team(world, setup, visible, hooks);
  ASSERT_TRUE(result.has_value()) << result.error().message;
  const std::filesystem::path pictures = std::filesystem::path(::testing::TempDir()) / "figure_8";
  ASSERT_TRUE(make_folder(pictures).has_value());
  const auto written = write_team_files(pictures, *world, setup, *result, visible);
  EXPECT_TRUE(written.has_value()) << written.error().message;
  EXPECT_TRUE(std::filesystem::exists(pictures / "explore.png"));

  // (a) While only the corridor is known, one goes and the other waits where it stood.
  const auto has_gone = [&](int robot, double t_s) {
    const Log& log = logs[static_cast<std::size_t>(robot)];
    double gone_m = 0.0;
    for (const Log::Entry& e : log.entries) {
      if (e.t_s <= t_s) gone_m = std::max(gone_m, (e.p_map - log.entries.front().p_map).norm());
    }
    return gone_m;
  };
  const int goer = has_gone(0, 20.0) > has_gone(1, 20.0) ? 0 : 1, waiter = 1 - goer;
  EXPECT_GT(has_gone(goer, 20.0), 7.0);
  EXPECT_LT(has_gone(waiter, 20.0), 0.6 * has_gone(goer, 20.0));
  // The sparse scanner of fidelity "plan" leaves stripes of unknown at the end of what it sees of a wall, and
  // some of them are a second goal for a moment: it does not wait all the time.
  const auto& waiting = logs[static_cast<std::size_t>(waiter)].entries;
  const auto waits = std::count_if(waiting.begin(), waiting.end(), [](const Log::Entry& e) {
    return e.t_s <= 20.0 && e.reason == "waits: others are nearer to every goal";
  });
  EXPECT_GE(waits, 8) << "of 25 periods";

  // (b) Each has been in an arm of its own.
  const auto extent = [](const RunResult& robot) {
    double east_m = 0.0, west_m = 0.0;  // of the junction's middle
    for (const sim::Se2& pose : robot.truth) {
      if (pose.y_m < 13.0) continue;
      east_m = std::max(east_m, pose.x_m - 8.8);
      west_m = std::max(west_m, 8.8 - pose.x_m);
    }
    return std::pair(east_m, west_m);
  };
  constexpr double kFar_m = 8.0;  // of 40 m: what is nearer both have looked into
  const auto [east_0, west_0] = extent(result->robots[0]);
  const auto [east_1, west_1] = extent(result->robots[1]);
  EXPECT_NE(east_0 > kFar_m, east_1 > kFar_m) << east_0 << ' ' << east_1;
  EXPECT_NE(west_0 > kFar_m, west_1 > kFar_m) << west_0 << ' ' << west_1;
  EXPECT_NE(east_0 > kFar_m, west_0 > kFar_m) << "nobody was in both";
  EXPECT_TRUE(result->team.home);
  EXPECT_EQ(result->team.collisions, 0U);
  EXPECT_GE(result->team.coverage.back().second, 0.98);
}

struct Corridors {
  double north_m, arm_m;
};

/// When one robot alone is home.
double home_alone_s(const Corridors& corridors) {
  sim::World world = junction(10.0, corridors.north_m, corridors.arm_m);
  const sim::Raster visible = visible_area(world);
  const RunSetup setup = setup_in(world);
  auto plant = make_plant(std::move(world), setup);
  EXPECT_TRUE(plant.has_value());
  const auto mind = make_mind(setup);
  const RunResult result = run_exploration(**plant, *mind, setup, visible);
  EXPECT_TRUE(result.home_s.has_value()) << result.reason;
  EXPECT_GE(result.coverage.back().second, 0.98);
  return result.home_s.value_or(0.0);
}

/// When both are, of which the second enters a minute after the first.
double home_together_s(const Corridors& corridors) {
  const auto world = std::make_shared<sim::World>(junction(10.0, corridors.north_m, corridors.arm_m));
  const sim::Raster visible = visible_area(*world);
  const TeamSetup setup{setup_in(*world), 2, {}, 60.0};
  std::array<Log, 2> logs;
  const std::array<RunHooks*, 2> hooks{&logs[0], &logs[1]};
  const auto result = run_team(world, setup, visible, hooks);
  EXPECT_TRUE(result.has_value());
  if (!result) return HUGE_VAL;
  for (const Log::Entry& e : logs[1].entries) {
    EXPECT_TRUE(e.t_s >= 60.0 || e.activity == pipeline::Activity::kIdle) << "it moves at " << e.t_s;
  }
  EXPECT_GE(result->team.coverage.back().second, 0.98);
  EXPECT_EQ(result->team.collisions, 0U);
  EXPECT_TRUE(result->team.home_s.has_value()) << result->team.reason;
  return result->team.home_s.value_or(HUGE_VAL);
}

/// In one building it may go either way, by where the two meet: the mean of several counts.
TEST(TeamStory, aSecondRobotAMinuteLaterMakesTheMissionShorter) {  // figure 10
  double alone_s = 0.0, together_s = 0.0;
  std::string times;
  for (const Corridors& corridors :
       {Corridors{12.0, 24.0}, {12.0, 30.0}, {12.0, 36.0}, {8.0, 30.0}, {16.0, 30.0}, {14.0, 34.0}}) {
    const double one_s = home_alone_s(corridors), two_s = home_together_s(corridors);
    alone_s += one_s;
    together_s += two_s;
    times += fmt::format(" {:.0f}/{:.0f}", two_s, one_s);
  }
  EXPECT_LT(together_s, 0.9 * alone_s) << "the paper: 283 s against 370 s; together/alone:" << times;
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The base thread's step in lock-step with the simulated robot, faults and all: nothing is touched that could
// be avoided (issue "Map to home", base thread and safety).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tests/integration/drive_rig.hpp"
#include "tests/integration/value_faults.hpp"
#include "tests/unit/sim/rooms.hpp"

namespace topo::test {
namespace {

using motion::GateReason;
using pipeline::ControlMode;
using sim::Vector2;

sim::World office() {
  auto world = sim::World::load(std::filesystem::path(TOPOMETRIC_SOURCE_DIR) / "config/worlds/office.toml");
  if (!world.has_value()) std::abort();
  return std::move(*world);
}

sim::World hall() { return sim::scene(sim::hall_text()); }

const std::vector<Vector2> kDownTheHall{{2.0, 4.0}, {28.0, 4.0}};

/// About 0.1 m apart, as a plan has it.
std::vector<Vector2> points_along(const std::vector<Vector2>& corners) {
  std::vector<Vector2> points{corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vector2 way = corners[i] - corners[i - 1];
    const int steps = std::max(1, static_cast<int>(way.norm() / 0.1));
    for (int k = 1; k <= steps; ++k)
      points.push_back(corners[i - 1] + way * (static_cast<double>(k) / steps));
  }
  return points;
}

DriveSetup drive_setup(const std::string& model, std::uint64_t seed) {
  DriveSetup setup;
  setup.model = model;
  setup.start = {2.0, 4.0, 0.0};
  setup.seed = seed;
  return setup;
}

/// A robot at full speed down the hall.
std::unique_ptr<DriveRig> at_full_speed(const std::string& model, std::uint64_t seed = 1) {
  auto rig = std::make_unique<DriveRig>(hall(), drive_setup(model, seed));
  rig->go(points_along(kDownTheHall));
  const double full_mps = rig->setup.limits.v_max_mps - 0.03;
  EXPECT_TRUE(rig->run(10.0, [&] { return rig->v_mps() > full_mps && rig->now_s() > 3.0; })) << model;
  return rig;
}

bool stands(const DriveRig& rig) { return std::abs(rig.v_mps()) < 1e-3; }

double front_gap_m(const DriveRig& rig, double box_front_x_m) {
  return box_front_x_m - rig.body().truth().x_m - rig.body().model().length_front_m;
}

class Safety : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Models, Safety, ::testing::Values("p3dx", "p3at"));

TEST_P(Safety, StopsBeforeBoxesThatAppearAMetreAhead) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto rig = at_full_speed(GetParam(), seed);
    const double v_mps = rig->v_mps(), from_m = rig->body().path_m();
    const auto box = rig->simulation().add_box_ahead(0, 1.0);
    ASSERT_TRUE(box.has_value());
    rig->run(6.0, [&] { return stands(*rig); });
    const double way_m = rig->body().path_m() - from_m;
    std::printf("%s, box 1 m ahead at %.2f m/s: stands or goes round after %.2f m\n", GetParam(), v_mps,
                way_m);
    rig->run(10.0);
    EXPECT_EQ(rig->body().collisions(), 0U) << seed;
  }
}

TEST_P(Safety, StopsInTimeWhenTheFrontLaserGoesSilent) {
  const auto rig = at_full_speed(GetParam());
  const double v_mps = rig->v_mps(), from_m = rig->body().path_m();
  const double limit_m = v_mps * (0.150 + 0.05 + 0.05) + v_mps * v_mps / (2.0 * 0.5) + 0.05;
  rig->front_silent = true;
  EXPECT_TRUE(rig->run(4.0, [&] { return stands(*rig); }));
  const double way_m = rig->body().path_m() - from_m;
  std::printf("%s, front laser silent at %.2f m/s: stands after %.2f m (limit %.2f m)\n", GetParam(), v_mps,
              way_m, limit_m);
  EXPECT_LT(way_m, limit_m);
  EXPECT_EQ(rig->report().reason, GateReason::kStaleScan);
  rig->front_silent = false;
  EXPECT_TRUE(rig->run(5.0, [&] { return rig->v_mps() > 0.5; })) << "it goes on by itself";
}

TEST_P(Safety, TheWatchdogStopsBeforeTheWallWhenTheHostDies) {
  for (const double wall_m : {1.2, 1.6, 2.0, 2.6}) {
    const auto rig = at_full_speed(GetParam());
    const double from_m = rig->body().path_m();
    const double face_x_m = rig->body().truth().x_m + 5.0;
    ASSERT_TRUE(
        rig->simulation().add_obstacle(sim::make_box({face_x_m + 0.2, 4.0, 0.0}, 0.4, 7.0, 0.0, 1.0)));
    rig->by_hand = types::Twist2{0.7, 0.0};  // straight at it, as fast as may be
    rig->run(60.0, [&] { return front_gap_m(*rig, face_x_m) < wall_m; });
    const double v_mps = rig->v_mps(), gap_m = front_gap_m(*rig, face_x_m), at_m = rig->body().path_m();
    rig->host_dead = true;
    rig->run(6.0);
    std::printf("%s, host dies %.2f m before a wall at %.2f m/s: rolls %.2f m\n", GetParam(), gap_m, v_mps,
                rig->body().path_m() - at_m);
    EXPECT_TRUE(stands(*rig));
    EXPECT_GT(rig->body().path_m(), from_m);
    EXPECT_EQ(rig->body().collisions(), 0U) << wall_m;
  }
}

TEST_P(Safety, EveryFaultStopsInTimeAndHealsUnlessItLatches) {
  for (const ValueFault& fault : plain_faults()) {
    const auto rig = at_full_speed(GetParam());
    const double v_mps = rig->v_mps(), from_m = rig->body().path_m(), from_s = rig->now_s();
    fault.begin(*rig);
    EXPECT_TRUE(rig->run(5.0, [&] { return stands(*rig); })) << fault.name;
    std::printf("%s, %s at %.2f m/s: stands after %.2f m, %.2f s\n", GetParam(), fault.name.c_str(), v_mps,
                rig->body().path_m() - from_m, rig->now_s() - from_s);
    // The slowest to be noticed is a planner that says nothing any more, after a second.
    EXPECT_LT(rig->body().path_m() - from_m, v_mps * 1.2 + v_mps * v_mps + 0.1) << fault.name;
    const double stood_m = rig->body().path_m();
    rig->run(1.0);
    EXPECT_NEAR(rig->body().path_m(), stood_m, 1e-6) << fault.name;
    heal(*rig);
    const bool moves = rig->run(5.0, [&] { return rig->v_mps() > 0.3; });
    EXPECT_EQ(moves, !fault.latches) << fault.name;
    if (fault.latches) {
      rig->estop_cleared = true;
      EXPECT_FALSE(rig->run(3.0, [&] { return rig->v_mps() > 0.01; })) << "the plan has to begin anew";
      rig->go(points_along(kDownTheHall));
      EXPECT_TRUE(rig->run(5.0, [&] { return rig->v_mps() > 0.3; })) << fault.name;
    }
    EXPECT_EQ(rig->body().collisions(), 0U) << fault.name;
  }
}

TEST_P(Safety, LeavesAPressedFrontBumperBackwardsAndGoesOn) {
  const auto rig = at_full_speed(GetParam());
  double backed_m = 0.0, furthest_m = 0.0;
  double until_s = rig->now_s() + 2.5;
  rig->spoil_state = [&](types::BaseState& b) {
    if (rig->now_s() < until_s) b.bumpers_front = 4;
  };
  rig->run(15.0, [&] {
    furthest_m = std::max(furthest_m, rig->body().truth().x_m);
    backed_m = std::max(backed_m, furthest_m - rig->body().truth().x_m);
    return false;
  });
  std::printf("%s, front bumper: backed off %.2f m\n", GetParam(), backed_m);
  EXPECT_GT(backed_m, 0.08);
  EXPECT_LT(backed_m, 0.55);
  EXPECT_GE(rig->report().recoveries, 1U);
  EXPECT_GT(rig->body().truth().x_m, furthest_m - 0.5);
}

TEST_P(Safety, IsStuckAfterABoundedTimeBeforeAWallAndTouchesNothing) {
  const auto rig = at_full_speed(GetParam());
  const double x_m = rig->body().truth().x_m + 3.0;
  ASSERT_TRUE(rig->simulation().add_obstacle(sim::make_box({x_m, 4.0, 0.0}, 0.2, 7.8, 0.0, 1.0)));
  const double from_s = rig->now_s();
  EXPECT_TRUE(rig->run(120.0, [&] { return rig->report().mode == ControlMode::kStuck; }));
  std::printf("%s, closed way: stuck after %.1f s, %u recoveries\n", GetParam(), rig->now_s() - from_s,
              rig->report().recoveries);
  EXPECT_EQ(rig->body().collisions(), 0U);
  rig->run(2.0);
  const double stood_m = rig->body().path_m();
  rig->run(10.0);
  EXPECT_NEAR(rig->body().path_m(), stood_m, 1e-6);
  rig->go(points_along({rig->body().truth().translation(), {2.0, 4.0}}));
  EXPECT_TRUE(rig->run(60.0, [&] { return rig->report().mode == ControlMode::kArrived; }))
      << "another goal begins anew";
  EXPECT_EQ(rig->body().collisions(), 0U);
}

TEST_P(Safety, PeopleCrossTheWay) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    DriveRig rig(hall(), drive_setup(GetParam(), seed));
    for (int i = 0; i < 5; ++i) {
      sim::Walker walker;
      const double x_m = 6.0 + 4.0 * i;
      walker.way_points = {{x_m, 1.0 + i}, {x_m + 1.0, 7.0}, {x_m - 1.0, 1.0}};
      walker.speed_mps = 0.6 + 0.15 * i;
      rig.simulation().add_walker(walker);
    }
    rig.go(points_along(kDownTheHall));
    const auto has_arrived = [&] { return rig.report().mode == ControlMode::kArrived; };
    // A person may wait for the robot that waits for the person: the goal is given up, as planning would.
    for (int tries = 0; tries < 3 && !has_arrived(); ++tries) {
      rig.run(100.0, [&] { return has_arrived() || rig.report().mode == ControlMode::kStuck; });
      if (!has_arrived()) rig.go(points_along({rig.body().truth().translation(), kDownTheHall.back()}));
    }
    std::printf("%s, five people: %.1f s for 26 m\n", GetParam(), rig.now_s());
    EXPECT_EQ(rig.body().collisions(), 0U) << seed;
  }
}

// Who walks about in the simulator stops before a robot: what a touch is like, moving_obstacles_test sees to.
TEST_P(Safety, GivesWayToSomebodyWhoCrossesItsWay) {
  int gave_way = 0;
  for (int phase = 0; phase < 6; ++phase) {
    const auto rig = at_full_speed(GetParam());
    const double x_m = rig->body().truth().x_m + 1.6, from_m = 5.4 + 0.36 * phase;
    sim::Walker walker;
    walker.speed_mps = 1.2;
    walker.way_points = {{x_m, from_m}, {x_m, 0.5}, {x_m, 0.4}};
    if (phase % 2 == 1)
      for (Vector2& p : walker.way_points) p.y() = 8.0 - p.y();
    rig->simulation().add_walker(walker);
    rig->run(5.0, [&] {
      gave_way += rig->report().reason == GateReason::kGivesWay ? 1 : 0;
      return false;
    });
    EXPECT_EQ(rig->body().collisions(), 0U) << phase;
    EXPECT_EQ(rig->report().recoveries, 0U) << phase;
  }
  std::printf("%s, somebody crosses: gives way in %d periods\n", GetParam(), gave_way);
  EXPECT_GT(gave_way, 0);
}

/// Does any part of the hull stand out of the area?
bool is_out(const DriveRig& rig, const types::AreaLimits& area) {
  for (const Vector2& corner : rig.body().model().footprint())
    if (!types::allows(area, rig.body().truth() * corner)) return true;
  return false;
}

TEST_P(Safety, NeitherTheHandNorAPlanTakesItOutOfTheArea) {
  DriveSetup setup = drive_setup(GetParam(), 1);
  DriveRig rig(hall(), setup);
  types::AreaLimits& area = rig.setup.area;
  area.keep_in = types::Polygon{{0.5, 1.0}, {12.0, 1.0}, {12.0, 7.0}, {0.5, 7.0}};
  area.keep_out.push_back({{6.0, 4.2}, {7.0, 4.2}, {7.0, 5.0}, {6.0, 5.0}});
  rig.by_hand = types::Twist2{0.7, 0.0};
  rig.planner_silent = true;
  EXPECT_FALSE(rig.run(3.0, [&] { return rig.v_mps() > 0.01; })) << "nobody knows where it is";
  EXPECT_EQ(rig.report().reason, GateReason::kNoPlace);
  rig.planner_silent = false;
  rig.lost = true;
  rig.go(points_along({{2.0, 4.0}, {28.0, 4.6}}));
  EXPECT_FALSE(rig.run(3.0, [&] { return rig.v_mps() > 0.01; })) << "a fresh plan of a planner that is lost";
  EXPECT_EQ(rig.report().reason, GateReason::kNoPlace);
  rig.by_hand.reset();
  EXPECT_FALSE(rig.run(3.0, [&] { return rig.v_mps() > 0.01; })) << "nor by the plan";
  rig.lost = false;
  rig.go(points_along({{2.0, 4.0}, {28.0, 4.6}}));
  bool out = false;
  rig.run(40.0, [&] {
    out = out || is_out(rig, area);
    return rig.report().mode == ControlMode::kStuck;
  });
  EXPECT_FALSE(out);
  rig.go({});
  for (const types::Twist2 twist :
       {types::Twist2{0.7, 0.3}, {0.7, -0.2}, {0.7, 0.0}, {0.7, 0.5}, {0.0, 0.8}, {0.7, -0.1}}) {
    rig.by_hand = twist;
    rig.run(12.0, [&] { return out = out || is_out(rig, area), false; });
  }
  EXPECT_FALSE(out);
  EXPECT_EQ(rig.body().collisions(), 0U);
}

TEST(SafetyInTheOffice, DrivesThroughDoorsAndClutteredCorridors) {
  const std::vector<Vector2> stops{{1.0, 7.0},   {12.0, 7.0},  {13.0, 4.0},  {12.0, 7.0},
                                   {25.0, 9.0},  {33.0, 13.0}, {25.0, 16.0}, {18.0, 19.0},
                                   {14.0, 16.0}, {13.0, 24.0}, {1.0, 18.0},  {1.0, 7.0}};
  for (const std::uint64_t seed : {1U}) {
    sim::World world = office();
    std::vector<std::vector<Vector2>> ways;
    for (std::size_t i = 1; i < stops.size(); ++i) ways.push_back(way_in(world, stops[i - 1], stops[i]));
    DriveSetup setup;
    setup.start = {1.0, 7.0, 0.0};
    setup.seed = seed;
    DriveRig rig(std::move(world), setup);
    for (const auto& way : ways) {
      ASSERT_FALSE(way.empty());
      rig.go(way);
      rig.run(200.0, [&] {
        return rig.report().mode == ControlMode::kArrived || rig.report().mode == ControlMode::kStuck;
      });
      EXPECT_EQ(rig.report().mode, ControlMode::kArrived) << way.back().transpose();
    }
    std::printf("office, seed %lu: %.1f m and %zu goals in %.1f s, %.2f m/s, %u recoveries\n", seed,
                rig.body().path_m(), ways.size(), rig.now_s(), rig.body().path_m() / rig.now_s(),
                rig.report().recoveries);
    EXPECT_EQ(rig.body().collisions(), 0U);
    EXPECT_GT(rig.body().path_m() / rig.now_s(), 0.4);
  }
}

}  // namespace
}  // namespace topo::test

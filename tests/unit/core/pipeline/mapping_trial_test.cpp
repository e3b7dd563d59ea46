// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The first metres in a session's map, as mapping_step takes them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "core/pipeline/mapping_step.hpp"
#include "core/slam/placement.hpp"
#include "tests/mocks/flat_world.hpp"

namespace topo::pipeline {
namespace {

using slam::TrialVerdict;
using types::Se2;

/// Robots in the twin rooms, with true odometry that begins where they do.
class MappingTrialTest : public ::testing::Test {
 protected:
  void begin(std::unique_ptr<MappingState> map, const Se2& truth) {
    state = std::move(map);
    from = at = truth;
  }
  void see(const Se2& truth) {
    at = truth;
    stamp += std::chrono::milliseconds(100);
    types::Odometry odometry;
    odometry.stamp = stamp;
    const Se2 T_odom_base = from.inverse() * truth;
    odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(T_odom_base);
    const types::Scan scan =
        mocks::take_scan(world, truth, stamp, {541, 1.5 * std::numbers::pi, 30.0, 0.01}, random);
    (void)mapping_step(*state, {{&odometry, 1}, &scan, nullptr});
  }
  /// Turns there, then drives straight.
  void drive_to(double x_m, double y_m) {
    const Se2 begin = at;
    const types::Vector2 way = types::Vector2{x_m, y_m} - begin.translation();
    const double heading = std::atan2(way.y(), way.x());
    const double turn = types::wrap_angle(heading - begin.theta_rad);
    for (int i = 1; i <= 20; ++i) see({begin.x_m, begin.y_m, begin.theta_rad + turn * i / 20});
    const int steps = static_cast<int>(way.norm() / 0.08);
    for (int i = 1; i <= steps; ++i)
      see({begin.x_m + way.x() * i / steps, begin.y_m + way.y() * i / steps, heading});
  }
  void turn_round() {
    const Se2 begin = at;
    for (int i = 1; i <= 25; ++i) see({begin.x_m, begin.y_m, types::wrap_angle(begin.theta_rad + 0.25 * i)});
  }
  /// Through both rooms; the session is kept.
  void map_the_building() {
    begin(std::make_unique<MappingState>(params), {3.5, 7.0, -1.57});
    see(at);
    turn_round();
    drive_to(3.5, 1.4);
    drive_to(11.5, 1.4);
    drive_to(11.5, 7.0);
    turn_round();
    EXPECT_EQ(state->trial().verdict, TrialVerdict::kNone) << "a map of its own needs none";
    session = state->mapper().session();
  }
  /// The robot is at one place, and the operator names another.
  void resume(const Se2& truth, const Se2& believed) {
    begin(std::make_unique<MappingState>(params, slam::Origin{1, 2}), truth);
    see(truth);
    const slam::Placement placed =
        place_in(session, state->cloud(), {Se2{3.5, 7.0, -1.57}.inverse() * believed, false, false}, params);
    ASSERT_TRUE(placed.is_fact()) << describe(placed);
    slam::Arrival arrival{state->cloud(), state->mapper().T_odom_base(), placed.place.match.T_map_base,
                          placed.place.match.scan_information};
    for (const slam::Match& other : placed.others) arrival.rivals.push_back(other.T_map_base);
    state = std::make_unique<MappingState>(params, session, arrival, slam::Origin{1, 3});
    EXPECT_EQ(state->trial().verdict, TrialVerdict::kRunning);
  }

  slam::MapperParams params;
  mocks::FlatWorld world = mocks::twin_rooms();
  std::mt19937 random{5};
  types::Stamp stamp = types::stamp_from_seconds(1.0);
  std::unique_ptr<MappingState> state;
  Se2 from, at;
  slam::Session session;
};

constexpr Se2 kRoom{2.5, 7.5, -0.6}, kTwin{10.5, 7.5, -0.6};

TEST_F(MappingTrialTest, ARightPlacePasses) {
  map_the_building();
  resume(kTwin, kTwin);
  drive_to(11.5, 6.5);
  drive_to(11.5, 1.4);
  drive_to(4.0, 1.4);
  EXPECT_EQ(state->trial().verdict, TrialVerdict::kPassed);
  EXPECT_EQ(state->trial().contradicted, 0);
}

TEST_F(MappingTrialTest, AWrongPlaceIsDropped) {
  map_the_building();
  resume(kTwin, kRoom);
  drive_to(11.5, 6.5);
  EXPECT_EQ(state->trial().verdict, TrialVerdict::kRunning) << "two places explain all that is seen";
  drive_to(11.5, 1.4);
  drive_to(8.0, 1.4);
  EXPECT_EQ(state->trial().verdict, TrialVerdict::kDropped);
  EXPECT_LT(state->trial().way_m, 8.0);
}

}  // namespace
}  // namespace topo::pipeline

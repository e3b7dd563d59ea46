// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/robot_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/sim/sonar.hpp"
#include "tests/unit/sim/rooms.hpp"

namespace topo::sim {
namespace {

using std::numbers::pi;

void drive(RobotBody& body, double seconds, double left, double right) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds * 1e3)); ++i) body.step(1e-3, left, right);
}

TEST(RobotBody, DrivesStraightAndTurnsOnTheSpotWithoutErrors) {
  World world = scene(room_text());
  RobotBody body(world, RobotModel::p3dx(), {2.0, 3.0, 0.0}, Difficulty::none(), 1);
  drive(body, 2.0, 0.5, 0.5);
  EXPECT_NEAR(body.truth().x_m, 3.0, 1e-9);
  EXPECT_NEAR(body.encoder_left_m(), 1.0, 1e-9);
  const double quarter_s = 0.25 * pi * body.model().track_m / 0.2;  // each wheel at 0.2 m/s
  drive(body, quarter_s, -0.2, 0.2);
  EXPECT_NEAR(body.truth().theta_rad, 0.5 * pi, 2e-3);
  EXPECT_NEAR(body.truth().x_m, 3.0, 1e-9);
  EXPECT_EQ(body.collisions(), 0U);
}

TEST(RobotBody, FollowsTheArcOfItsWheels) {
  World world = scene(room_text());
  RobotBody body(world, RobotModel::p3dx(), {4.0, 1.5, 0.0}, Difficulty::none(), 1);
  const double radius = 1.0;
  const double track = body.model().track_m;
  drive(body, 0.5 * pi / 0.5, 0.5 * (radius - 0.5 * track), 0.5 * (radius + 0.5 * track));  // 0.5 rad/s
  EXPECT_NEAR(body.truth().x_m, 5.0, 2e-3);
  EXPECT_NEAR(body.truth().y_m, 2.5, 2e-3);
  EXPECT_NEAR(body.true_twist().omega_radps, 0.5, 1e-9);
}

TEST(RobotBody, AWallStopsItAndTheFrontBumperSaysSo) {
  World world = scene(room_text());
  RobotBody body(world, RobotModel::p3dx(), {7.0, 3.0, 0.0}, Difficulty::none(), 1);
  drive(body, 5.0, 0.5, 0.5);
  EXPECT_NEAR(body.truth().x_m, 8.0 - body.model().length_front_m, 1e-3);
  EXPECT_NEAR(body.encoder_left_m(), body.truth().x_m - 7.0, 1e-9);  // blocked wheels stand
  EXPECT_EQ(body.contact().side, ContactSide::kFront);
  EXPECT_EQ(body.contact().bumpers_front, 1U << 2U);  // the middle one of five
  EXPECT_EQ(body.contact().bumpers_rear, 0);
  EXPECT_TRUE(body.contact().stall_left);
  EXPECT_TRUE(body.contact().stall_right);
  EXPECT_EQ(body.collisions(), 1U);
  EXPECT_EQ(body.true_twist(), types::Twist2{});
  drive(body, 0.1, 0.0, 0.0);
  EXPECT_FALSE(body.contact().stall_left);
  EXPECT_NE(body.contact().bumpers_front, 0);  // still leaning on the wall
  drive(body, 1.0, -0.2, -0.2);
  EXPECT_EQ(body.contact().side, ContactSide::kNone);
  EXPECT_LT(body.truth().x_m, 7.7);
}

// Shorter steps fit into what is left before the wall; the bumper stays pressed meanwhile.
TEST(RobotBody, BrakingOrSlippingAgainstAWallIsOneCollision) {
  World world = scene(room_text());
  RobotBody body(world, RobotModel::p3dx(), {7.0002, 3.0, 0.0}, Difficulty::none(), 1);
  drive(body, 5.0, 0.5, 0.5);
  for (double speed = 0.5; speed > 0.0; speed -= 0.0007) {
    body.step(1e-3, speed, speed);
    ASSERT_EQ(body.contact().side, ContactSide::kFront) << speed;
  }
  EXPECT_EQ(body.collisions(), 1U);
  drive(body, 0.1, -0.1, -0.1);
  EXPECT_EQ(body.contact().side, ContactSide::kNone);
  drive(body, 1.0, 0.1, 0.1);
  EXPECT_EQ(body.collisions(), 2U);
}

TEST(RobotBody, TheRearBumperAndTheOuterSegmentsAreTold) {
  World world = scene(room_text() + R"([[cylinder]]
center_m = [4.6, 3.12]
radius_m = 0.03
z_max_m = 1.0
)");
  RobotBody back(world, RobotModel::p3dx(), {1.0, 3.0, 0.0}, Difficulty::none(), 1);
  drive(back, 5.0, -0.5, -0.5);
  EXPECT_EQ(back.contact().side, ContactSide::kRear);
  EXPECT_EQ(back.contact().bumpers_rear, 1U << 2U);
  RobotBody left(world, RobotModel::p3dx(), {4.0, 3.0, 0.0}, Difficulty::none(), 1);
  drive(left, 5.0, 0.3, 0.3);
  EXPECT_EQ(left.contact().side, ContactSide::kFront);
  EXPECT_EQ(left.contact().bumpers_front, 1U << 0U);  // the pole is left of the middle
}

TEST(RobotBody, LowThingsStopItAndHighOnesDoNot) {
  const std::string box = R"([[box]]
center_m = [6.0, 3.0]
length_m = 1.0
width_m = 1.0
)";
  const auto stops_at = [&](const std::string& heights) {
    World world = scene(room_text() + box + heights);
    RobotBody body(world, RobotModel::p3dx(), {4.0, 3.0, 0.0}, Difficulty::none(), 1);
    drive(body, 4.0, 0.5, 0.5);
    return body.truth().x_m;
  };
  EXPECT_NEAR(stops_at("z_max_m = 0.14\n"), 5.5 - 0.21, 1e-3);  // under the scanner, not under the body
  EXPECT_NEAR(stops_at("z_min_m = 0.45\nz_max_m = 1.0\n"), 5.5 - 0.21, 1e-3);  // the mast meets it
  EXPECT_NEAR(stops_at("z_min_m = 0.7\nz_max_m = 0.8\n"), 6.0, 1e-6);          // a table top
  EXPECT_NEAR(stops_at("z_max_m = 0.02\n"), 6.0, 1e-6);                        // a door sill
}

TEST(RobotBody, RobotsBlockEachOther) {
  World world = scene(room_text());
  RobotBody a(world, RobotModel::p3dx(), {2.0, 3.0, 0.0}, Difficulty::none(), 1);
  RobotBody b(world, RobotModel::p3at(), {4.0, 3.0, 0.0}, Difficulty::none(), 1);
  drive(a, 6.0, 0.5, 0.5);
  EXPECT_NEAR(a.truth().x_m, 4.0 - b.model().length_rear_m - a.model().length_front_m, 1e-3);
  EXPECT_EQ(a.collisions(), 1U);
}

TEST(RobotBody, ErrorsOfTheWheelsAreOfTheStatedSize) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    World world = scene(room_text());
    Difficulty difficulty;
    difficulty.slip_interval_s = 0.0;
    RobotBody body(world, RobotModel::p3dx(), {4.0, 3.0, 0.0}, difficulty, seed);
    drive(body, 1.0, 0.3, 0.3);
    // Each wheel is 2 % off, so the way is 2 % off or the wheels pull apart by 4 %; the track is 5 % off.
    const double turn = std::abs(body.truth().theta_rad) * body.model().track_m / 0.3;
    const double way = std::abs(body.path_m() / 0.3 - 1.0);
    if (turn > 1e-9) {
      EXPECT_NEAR(turn, 0.04 / (turn > 0.04 ? 0.95 : 1.05), 1e-6);
      EXPECT_NEAR(way, 0.0, 1e-9);
    } else {
      EXPECT_NEAR(way, 0.02, 1e-9);
    }
    EXPECT_NEAR(body.encoder_left_m(), 0.3, 1e-9);
  }
}

TEST(RobotBody, SlipsInBurstsOfTheStatedRate) {
  World world = scene(room_text());
  const Difficulty difficulty;
  RobotBody body(world, RobotModel::p3dx(), {4.0, 3.0, 0.0}, difficulty, 5);
  int bursts = 0;
  bool before = false;
  constexpr int kSeconds = 2000;
  for (int i = 0; i < kSeconds * 200; ++i) {
    body.step(5e-3, -0.1, 0.1);
    bursts += body.slipping() && !before ? 1 : 0;
    before = body.slipping();
  }
  EXPECT_NEAR(bursts, kSeconds / (difficulty.slip_interval_s + 0.5), 30.0);
}

TEST(RobotBody, RemembersWhereItWas) {
  World world = scene(room_text());
  RobotBody body(world, RobotModel::p3dx(), {2.0, 3.0, 0.0}, Difficulty::none(), 1);
  drive(body, 2.0, 0.5, 0.5);
  EXPECT_NEAR(body.pose_at(SimTime{1'500'000'000}).x_m, 2.75, 1e-9);
  EXPECT_NEAR(body.pose_at(SimTime{1'500'400'000}).x_m, 2.7502, 1e-9);
  EXPECT_NEAR(body.pose_at(SimTime{1'000'000'000}).x_m, 2.5, 1e-3);
  EXPECT_NEAR(body.pose_at(SimTime{9'000'000'000}).x_m, 3.0, 1e-9);
}

TEST(RobotModel, FootprintsStayWithinTheSwingCircle) {
  for (const RobotModel& model : {RobotModel::p3dx(), RobotModel::p3at()}) {
    const Polygon outline = model.footprint();
    EXPECT_GT(area_m2(outline), 0.0);
    for (const Vector2& p : outline) EXPECT_LE(p.norm(), model.swing_radius_m + 1e-9) << model.subclass;
    EXPECT_NEAR(bounds(outline).max.x(), model.length_front_m, 1e-9);
    EXPECT_NEAR(bounds(outline).max.y(), 0.5 * model.width_m, 1e-9);
  }
}

TEST(Sonar, HearsTheNearestThingInItsConeOrNothing) {
  World world = scene(room_text() + R"([[box]]
center_m = [5.0, 3.0]
length_m = 0.2
width_m = 0.6
z_max_m = 0.2
)");
  Random random(1);
  const RobotModel model = RobotModel::p3dx();
  const auto hear = [&](int index, const Se2& pose) {
    return measure_sonar(world, model, pose, index, SimTime{0}, Difficulty::none(), random, kNoMovable)
        .range_m;
  };
  // Transducer 3 looks 10 degrees to the left from (0.166, 0.027): the low box's front is at x = 4.9.
  EXPECT_NEAR(hear(3, {3.0, 3.0, 0.0}), 4.9 - 3.166, 0.03);
  EXPECT_NEAR(hear(0, {3.0, 3.0, 0.0}), 6.0 - 3.136, 0.01);  // to the left, the wall
  EXPECT_EQ(hear(8, {3.0, 0.27, 0.0}), kSonarRangeMin_m);    // backwards right, nearly at the wall
  const World empty = scene(
      "[[start]]\nx_m = 1.0\ny_m = 1.0\n[[wall]]\npoints_m = [[0.0, 0.0], [9.0, 0.0]]\n[[wall]]\npoints_m = "
      "[[0.0, 20.0], [9.0, 20.0]]\n");
  EXPECT_EQ(
      measure_sonar(empty, model, {5.0, 6.0, 0.5 * pi}, 3, SimTime{0}, Difficulty::none(), random, kNoMovable)
          .range_m,
      5.0);
}

}  // namespace
}  // namespace topo::sim

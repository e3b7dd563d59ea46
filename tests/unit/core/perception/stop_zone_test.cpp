// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/stop_zone.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "core/perception/footprint_sweep.hpp"
#include "tests/unit/core/motion/surroundings.hpp"

namespace topo::perception {
namespace {

using motion::empty_scan;
using motion::kAhead;
using motion::put_wall_ahead;

using types::Stamp;

constexpr Stamp kNow{std::chrono::seconds(10)};
constexpr types::Twist2 kForward{0.5, 0.0};

struct StopZone : testing::Test {
  std::unique_ptr<types::Scan> scan = empty_scan(kNow);
  types::RobotLimits limits;
  std::array<types::SonarReading, 32> sonar{};
  std::array<types::Se2, 2> poses{types::Se2{0.15, 0.0, 0.0}, types::Se2{-0.25, 0.0, std::numbers::pi}};
  types::Se2 mount{0.1, 0.0, 0.0};

  [[nodiscard]] Surroundings scan_alone() const {
    Surroundings around;
    around.front_scan = scan.get();
    around.T_base_laser = mount;
    return around;
  }
  [[nodiscard]] double free_m(const types::Twist2& twist = kForward) const {
    const Surroundings around{
        .front_scan = scan.get(), .T_base_laser = mount, .sonar = sonar, .T_base_sonar = poses, .now = kNow};
    return free_distance_m(twist, free_time_s(twist, limits, around));
  }
};

TEST_F(StopZone, NothingAheadIsFree) {
  EXPECT_EQ(free_m(), kNever_s);
  EXPECT_EQ(free_m({std::nan(""), 0.0}), 0.0);
}

TEST_F(StopZone, MeasuresFromTheFrontWithTheMargin) {
  put_wall_ahead(*scan, 2.0);
  EXPECT_NEAR(free_m(), 2.0 + 0.1 - 0.21 - 0.05, 1e-3);
}

TEST_F(StopZone, AnArcPassesWhatStraightAheadMeets) {
  scan->range_m[kAhead] = 1.0F;  // a post
  EXPECT_LT(free_m(), 1.0);
  EXPECT_EQ(free_m({0.3, 1.2}), kNever_s);
}

TEST_F(StopZone, ALoneDropoutIsBridged) {
  for (const std::size_t width : {1U, 2U, 3U}) {
    for (std::size_t i = 0; i < width; ++i) scan->range_m[kAhead + i] = types::kInvalid;
    EXPECT_EQ(free_m(), kNever_s) << width;
  }
  put_wall_ahead(*scan, 2.0);
  scan->range_m[kAhead] = types::kInvalid;
  EXPECT_NEAR(free_m(), 1.84, 1e-3);
}

TEST_F(StopZone, ADropoutBesideAPostIsPartOfThePost) {
  scan->range_m[kAhead] = 1.0F;
  scan->range_m[kAhead + 1] = types::kInvalid;
  scan->range_m[kAhead + 2] = 3.0F;
  EXPECT_NEAR(free_m(), 1.0 + 0.1 - 0.26, 1e-2);
}

TEST_F(StopZone, AWideGapOfInvalidBeamsAheadIsAnObstacle) {
  for (std::size_t i = 0; i < 4; ++i) scan->range_m[kAhead + i] = types::kInvalid;
  EXPECT_EQ(free_m(), 0.0);
}

TEST_F(StopZone, InvalidBeamsOutsideTheForwardSectorDoNotCount) {
  for (std::size_t i = 0; i < 200; ++i) scan->range_m[i] = types::kInvalid;  // right and behind
  EXPECT_EQ(free_m(), kNever_s);
}

TEST_F(StopZone, TooNearAheadIsAnObstacle) {
  scan->range_m[kAhead + 30] = types::kTooNear;
  EXPECT_EQ(free_m(), 0.0);
  scan->range_m[kAhead + 30] = types::kNoReturn;
  scan->range_m[10] = types::kTooNear;
  EXPECT_EQ(free_m(), kNever_s);
}

TEST_F(StopZone, TheRobotsOwnBodyBesideTheLaserIsNoObstacle) {
  scan->range_m[kAhead + 400] = 0.15F;  // 100 degrees to the left, within the outline
  EXPECT_EQ(free_m(), kNever_s);
  scan->range_m[kAhead] = 0.105F;  // ahead, within the outline
  EXPECT_EQ(free_m(), 0.0);
}

TEST_F(StopZone, ATurnedMountTurnsTheSector) {
  mount.theta_rad = std::numbers::pi / 2;
  for (std::size_t i = 0; i < 4; ++i) scan->range_m[kAhead + i] = types::kInvalid;  // now to the left
  EXPECT_EQ(free_m(), kNever_s);
  scan->range_m[kAhead - 360] = 1.0F;  // now ahead
  EXPECT_NEAR(free_m(), 0.84, 1e-3);
}

TEST_F(StopZone, SonarSeesWhatTheLaserDoesNot) {
  sonar[0] = {kNow, 1.0F};
  EXPECT_NEAR(free_m(), 0.15 + 1.0 - 0.26, 1e-6);
  sonar[0].range_m = 5.0F;  // nothing seen
  EXPECT_EQ(free_m(), kNever_s);
}

TEST_F(StopZone, OldSonarReadingsDoNotCount) {
  sonar[0] = {kNow - std::chrono::milliseconds(501), 1.0F};
  EXPECT_EQ(free_m(), kNever_s);
  sonar[0] = {Stamp{}, 1.0F};
  EXPECT_EQ(free_m(), kNever_s);
  sonar[5] = {kNow, 1.0F};  // no pose is known
  EXPECT_EQ(free_m(), kNever_s);
}

TEST_F(StopZone, RearSonarGuardsTheWayBack) {
  sonar[1] = {kNow, 0.5F};
  EXPECT_EQ(free_m(), kNever_s);
  EXPECT_NEAR(free_m({-0.1, 0.0}), 0.25 + 0.5 - 0.301 - 0.05, 1e-6);
}

TEST_F(StopZone, CountsValidBeamsOfTheForwardSectorOnly) {
  EXPECT_EQ(forward_valid_fraction(*scan, mount, {}), 1.0);
  for (std::size_t i = kAhead; i < 1081; ++i) scan->range_m[i] = types::kInvalid;
  EXPECT_NEAR(forward_valid_fraction(*scan, mount, {}), 0.5, 0.01);
  scan->beams = 0;
  EXPECT_EQ(forward_valid_fraction(*scan, mount, {}), 0.0);
}

/// What a room full of things looks like: mostly distances outside of the robot, and nothing. In one of four,
/// all that a beam may say else, which stops the robot at once where it is ahead.
void measure_anything(types::Scan& scan) {
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  const auto below = [&](unsigned end) {
    return std::uniform_int_distribution<unsigned>(0, end - 1)(random);
  };
  const unsigned share = 2 + below(38);
  const bool may_fail = below(4) == 0;
  float range_m = 1.0F;
  for (std::size_t i = 0; i < scan.beams; ++i) {
    if (below(12) == 0) range_m = 0.35F + static_cast<float>(below(365)) * 0.01F;
    scan.range_m[i] = range_m;
    if (below(share) != 0) continue;
    const float fails = below(2) == 0 ? types::kInvalid : types::kTooNear;
    scan.range_m[i] = may_fail ? fails : types::kNoReturn;
  }
}

types::Twist2 any_twist() { return {*rc::gen::inRange(-30, 71) * 0.01, *rc::gen::inRange(-140, 141) * 0.01}; }

bool nearly_the_same(double a, double b) { return a == b || std::abs(a - b) < 1e-3; }

TEST_F(StopZone, PointsTakenOnceAnswerAsTheScanDoes) {
  EXPECT_TRUE(rc::check([this] {
    measure_anything(*scan);
    sonar[0] = {kNow, static_cast<float>(*rc::gen::inRange(10, 600)) * 0.01F};
    mount.theta_rad = *rc::gen::inRange(-30, 31) * 0.01;
    std::vector<ScanPoint> points(scan->beams);
    points.resize(scan_points(*scan, mount, {}, points));
    Surroundings walked{
        .front_scan = scan.get(), .T_base_laser = mount, .sonar = sonar, .T_base_sonar = poses, .now = kNow};
    walked.backing_off = *rc::gen::arbitrary<bool>();
    Surroundings taken = walked;
    taken.points = points;
    const types::Twist2 twist = any_twist();
    RC_ASSERT(free_time_s(twist, limits, taken) == free_time_s(twist, limits, walked));
    RC_ASSERT(slip_free_time_s(twist, limits, taken) == slip_free_time_s(twist, limits, walked));
    std::vector<types::Vector2> a(2000), b(2000);
    a.resize(collect_obstacles(limits, taken, 2.0, 0.03, a));
    b.resize(collect_obstacles(limits, walked, 2.0, 0.03, b));
    RC_ASSERT(a == b);
  }));
}

TEST_F(StopZone, AMirroredScanStopsTheMirroredMotionThen) {
  int later = 0;  // than at once
  mount.theta_rad = 0.0;
  EXPECT_TRUE(rc::check([&] {
    measure_anything(*scan);
    const types::Twist2 twist = any_twist(), other{twist.v_mps, -twist.omega_radps};
    const auto times = [&](const types::Twist2& t) {
      const Surroundings around = scan_alone();
      return std::pair(free_time_s(t, limits, around), slip_free_time_s(t, limits, around));
    };
    const auto [free_s, slip_s] = times(twist);
    std::reverse(scan->range_m.begin(), scan->range_m.begin() + scan->beams);
    const auto [other_free_s, other_slip_s] = times(other);
    RC_ASSERT(nearly_the_same(free_s, other_free_s));
    RC_ASSERT(nearly_the_same(slip_s, other_slip_s));
    later += free_s > 0.0 && std::isfinite(free_s) ? 1 : 0;
  }));
  EXPECT_GT(later, 10);
}

TEST_F(StopZone, SlipLeadsToTheNearerOfTwoArcs) {
  int later = 0;  // than at once
  EXPECT_TRUE(rc::check([&] {
    measure_anything(*scan);
    const types::Twist2 twist = any_twist();
    std::vector<ScanPoint> points(scan->beams);
    points.resize(scan_points(*scan, mount, {}, points));
    double expected_s = kNever_s;
    for (const ScanPoint& point : points) {
      if (!point.forward && contains(limits.footprint, point.p_base)) continue;
      for (const double slip : {1.7, -1.7}) {
        const types::Twist2 arc{twist.v_mps, twist.omega_radps + slip * twist.v_mps};
        expected_s = std::min(expected_s, contact_time_s(point.p_base, arc, limits.footprint));
      }
    }
    if (!(twist.v_mps > 0.0)) expected_s = kNever_s;
    const Surroundings around = scan_alone();
    RC_ASSERT(slip_free_time_s(twist, limits, around) == expected_s);
    later += expected_s > 0.0 && std::isfinite(expected_s) ? 1 : 0;
  }));
  EXPECT_GT(later, 10);
}

TEST_F(StopZone, CollectedObstaclesAreInReachAndThinned) {
  EXPECT_TRUE(rc::check([this] {
    measure_anything(*scan);
    const double reach_m = *rc::gen::inRange(1, 40) * 0.1, spacing_m = *rc::gen::inRange(0, 20) * 0.01;
    const Surroundings around = scan_alone();
    std::vector<ScanPoint> points(scan->beams);
    points.resize(scan_points(*scan, mount, {}, points));
    std::vector<types::Vector2> expected, out(*rc::gen::element<std::size_t>(0, 7, 2000));
    for (const ScanPoint& point : points) {
      if (expected.size() == out.size() || point.p_base.norm() >= reach_m) continue;
      if (!point.forward && contains(limits.footprint, point.p_base)) continue;
      if (!expected.empty() && (point.p_base - expected.back()).norm() < spacing_m) continue;
      expected.push_back(point.p_base);
    }
    out.resize(collect_obstacles(limits, around, reach_m, spacing_m, out));
    RC_ASSERT(out == expected);
  }));
}

TEST_F(StopZone, ALoneHitBetweenFartherOnesIsAMixedPixel) {
  const auto free_with_speck_at = [&](float range_m, std::size_t beams) {
    put_wall_ahead(*scan, 4.0);
    for (std::size_t i = 0; i < beams; ++i) scan->range_m[kAhead + i] = range_m;
    return free_m();
  };
  const double to_wall_m = 4.0 + 0.1 - 0.26;
  EXPECT_NEAR(free_with_speck_at(2.0F, 1), to_wall_m, 1e-3);
  EXPECT_NEAR(free_with_speck_at(2.0F, 2), 2.0 + 0.1 - 0.26, 1e-2) << "two beams";
  EXPECT_NEAR(free_with_speck_at(0.69F, 1), 0.69 + 0.1 - 0.26, 1e-2) << "too near to be one";
  EXPECT_NEAR(free_with_speck_at(3.9F, 1), 3.9 + 0.1 - 0.26, 1e-2) << "part of the wall";
}

TEST_F(StopZone, WhoBacksOffLeavesWhatTouchesItsFront) {
  scan->range_m[kAhead] = 0.105F;  // within the outline
  sonar[0] = {kNow, 0.02F};
  Surroundings around{
      .front_scan = scan.get(), .T_base_laser = mount, .sonar = sonar, .T_base_sonar = poses, .now = kNow};
  EXPECT_EQ(free_time_s({-0.1, 0.0}, limits, around), 0.0);
  around.backing_off = true;
  EXPECT_EQ(free_time_s({-0.1, 0.0}, limits, around), kNever_s);
  sonar[1] = {kNow, 0.5F};
  EXPECT_NEAR(free_time_s({-0.1, 0.0}, limits, around) * 0.1, 0.25 + 0.5 - 0.301 + 0.03, 1e-6)
      << "along its trail to the hull less the noise";
}

TEST_F(StopZone, TheRememberedGapIsThatToTheNearestRememberedPoint) {
  std::vector<ScanPoint> points{
      {{-0.5, 0.0}, false, false}, {{-0.4, 0.0}, false, true}, {{0.0, 0.3}, false, true}};
  Surroundings around;
  around.points = points;
  EXPECT_NEAR(remembered_gap_m(limits, around, 1.0), 0.3 - limits.footprint.half_width_m, 1e-9);
  EXPECT_EQ(remembered_gap_m(limits, around, 0.05), 0.05);
  points[2].remembered = false;
  EXPECT_NEAR(remembered_gap_m(limits, around, 1.0), 0.4 - limits.footprint.rear_m, 1e-9);
  points[1].p_base = {0.1, 0.1};
  EXPECT_EQ(remembered_gap_m(limits, around, 1.0), 0.0) << "within the outline";
  around.points = {};
  EXPECT_EQ(remembered_gap_m(limits, around, 1.0), 1.0);
}

TEST(FreeDistance, IsThatOfTheCentre) {
  EXPECT_EQ(free_distance_m({0.5, 1.0}, 3.0), 1.5);
  EXPECT_EQ(free_distance_m({-0.5, 0.0}, 3.0), 1.5);
  EXPECT_EQ(free_distance_m({0.0, 1.0}, 3.0), kNever_s);
  EXPECT_EQ(free_distance_m({0.0, 1.0}, 0.0), 0.0);
  EXPECT_EQ(free_distance_m({0.5, 0.0}, kNever_s), kNever_s);
  EXPECT_TRUE(is_on_the_spot({0.009, 0.0}, {}));
  EXPECT_TRUE(is_on_the_spot({-0.009, 1.0}, {}));
  EXPECT_FALSE(is_on_the_spot({0.011, 1.0}, {}));
  EXPECT_FALSE(is_on_the_spot({-0.011, 1.0}, {}));
}

TEST_F(StopZone, DirectionsWithoutABeamAreNotSeen) {
  const auto fraction_at = [&](double yaw_deg) {
    return forward_valid_fraction(*scan, {0.1, 0.0, yaw_deg * types::kDegree_rad}, {});
  };
  // The view of 270 degrees contains the forward sector up to a turn of 75 degrees.
  for (const double yaw_deg : {-75.0, -30.0, 0.1, 74.9})
    EXPECT_NEAR(fraction_at(yaw_deg), 1.0, 0.003) << yaw_deg;
  EXPECT_NEAR(fraction_at(105.0), 0.75, 0.01);
  EXPECT_NEAR(fraction_at(-135.0), 0.5, 0.01);
  EXPECT_NEAR(fraction_at(180.0), 0.25, 0.01);
  scan->beams = 361;  // from -135 to -45 degrees
  EXPECT_NEAR(fraction_at(0.0), 0.125, 0.01);
}

TEST_F(StopZone, AScanWithoutAStepBetweenBeamsSeesNothing) {
  for (const float step_rad : {0.0F, std::nanf(""), HUGE_VALF}) {
    scan->geometry.angle_min_rad = 0.0F;
    scan->geometry.angle_increment_rad = step_rad;
    EXPECT_EQ(forward_valid_fraction(*scan, mount, {}), 0.0) << step_rad;
  }
}

TEST_F(StopZone, CoarseAndDenseScansAreSeenWhole) {
  for (const int beams : {181, 361, 721}) {
    scan->beams = static_cast<std::uint16_t>(beams);
    scan->geometry.angle_min_rad = -std::numbers::pi_v<float> / 2.0F;
    scan->geometry.angle_increment_rad = std::numbers::pi_v<float> / static_cast<float>(beams - 1);
    EXPECT_EQ(forward_valid_fraction(*scan, mount, {}), 1.0) << beams;
  }
}

}  // namespace
}  // namespace topo::perception

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/mapper.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// Poses every 0.1 m or 5 degrees along straight legs with turns on the spot.
std::vector<Se2> drive(const std::vector<types::Vector2>& corners) {
  std::vector<Se2> poses{{corners[0].x(), corners[0].y(), 0.0}};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const types::Vector2 leg = corners[i] - corners[i - 1];
    const double heading = std::atan2(leg.y(), leg.x());
    const double turn = types::wrap_angle(heading - poses.back().theta_rad);
    const int turns = static_cast<int>(std::abs(turn) / 0.087);
    for (int k = 1; k <= turns; ++k) {
      poses.push_back(
          {poses.back().x_m, poses.back().y_m, types::wrap_angle(poses.back().theta_rad + turn / turns)});
    }
    const int steps = static_cast<int>(leg.norm() / 0.1);
    for (int k = 1; k <= steps; ++k) {
      const types::Vector2 p = corners[i - 1] + leg * k / steps;
      poses.push_back({p.x(), p.y(), heading});
    }
  }
  return poses;
}

struct Trial {
  std::vector<Se2> estimate;
  std::vector<Se2> truth;
  std::vector<Se2> odometry;
  int closures = 0;
  int lost = 0;
};

/// Odometry with 2 % of scale error and 4 % of turn error; scans with 2 cm of noise.
Trial run(const mocks::FlatWorld& world, const std::vector<Se2>& truth, const MapperParams& params,
          unsigned seed) {
  std::mt19937 random(seed);
  Mapper mapper(params);
  walls::ColumnCollector columns(params.coronal);
  Trial out;
  Se2 odometry;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i > 0) {
      const Se2 step = truth[i - 1].inverse() * truth[i];
      odometry = odometry * Se2{step.x_m * 1.02, step.y_m, step.theta_rad * 1.04 + 0.0004};
    }
    const testing::View view = testing::view_of(world, truth[i], 0.02, random);
    const MatchReport report = mapper.add(view.cloud, odometry, columns);
    out.lost += report.matched ? 0 : 1;
    if (const auto query = mapper.take_query()) out.closures += mapper.apply(find_closures(*query)).accepted;
    testing::correct(mapper);
    out.odometry.push_back(truth[0] * odometry);
    out.estimate.push_back(truth[0] * mapper.T_map_base());
    out.truth.push_back(truth[i]);
  }
  return out;
}

double end_error(const std::vector<Se2>& estimate, const std::vector<Se2>& truth) {
  return (estimate.back().translation() - truth.back().translation()).norm();
}

// A way without closures is solved now and then, for its walls.
TEST(Mapper, AsksForASolutionWhenTheWallsOfManyKeyframesWait) {
  const auto truth =
      drive({{2.0, 2.0}, {4.0, 2.0}, {4.0, 4.0}, {2.0, 4.0}, {2.0, 2.0}, {4.0, 2.0}, {4.0, 4.0}});
  const MapperParams params;
  std::mt19937 random(5);
  Mapper mapper(params);
  walls::ColumnCollector columns(params.coronal);
  std::optional<GraphQuery> asked;
  for (std::size_t i = 0; i < truth.size() && !asked; ++i) {
    const testing::View view = testing::view_of(mocks::two_rooms(), truth[i], 0.02, random);
    (void)mapper.add(view.cloud, truth[0].inverse() * truth[i], columns);
    asked = mapper.take_graph_query();
  }
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->poses.size(), params.graph.keyframes_before_solve);
  EXPECT_EQ(asked->headings.size(), asked->poses.size());
  EXPECT_FALSE(mapper.take_graph_query()) << "one at a time";
}

// 14 m of path through a door: a drift of 0.4 % and not more, without any loop to close.
TEST(Mapper, TracksThroughTwoRoomsToCentimetres) {
  const Trial out =
      run(mocks::two_rooms(), drive({{1.5, 1.5}, {5.0, 1.5}, {5.0, 3.6}, {9.0, 3.6}, {9.0, 6.0}}), {}, 1);
  EXPECT_EQ(out.lost, 0);
  for (std::size_t i = 0; i < out.truth.size(); ++i) {
    EXPECT_LT((out.estimate[i].translation() - out.truth[i].translation()).norm(), 0.05) << i;
  }
  EXPECT_GT(end_error(out.odometry, out.truth), 0.2) << "odometry alone must not do";
}

TEST(Mapper, ClosesARing) {
  const auto truth = drive({{1.2, 1.2}, {22.8, 1.2}, {22.8, 16.8}, {1.2, 16.8}, {1.2, 1.2}, {12.0, 1.2}});
  const Trial out = run(mocks::ring_corridor(), truth, {}, 2);
  EXPECT_GT(out.closures, 3);
  EXPECT_EQ(out.lost, 0);
  EXPECT_GT(end_error(out.odometry, out.truth), 2.0);
  EXPECT_LT(end_error(out.estimate, out.truth), 0.08);
}

/// The answers to all questions are lost but one, which bends the way back by half a metre.
TEST(Mapper, AsksAgainWhatACorrectionMoved) {
  const mocks::FlatWorld world = mocks::two_rooms();
  const auto truth =
      drive({{1.5, 1.5}, {5.0, 1.5}, {5.0, 3.6}, {9.0, 3.6}, {5.0, 3.6}, {5.0, 1.5}, {1.5, 1.5}});
  std::mt19937 random(2);
  Mapper mapper({}, {}, truth.front());
  walls::ColumnCollector columns({});
  std::optional<LoopQuery> last;
  for (const Se2& pose : truth) {
    (void)mapper.add(testing::view_of(world, pose, 0.02, random).cloud, pose, columns);
    if (auto query = mapper.take_query()) last = std::move(query);
  }
  ASSERT_TRUE(last);
  EXPECT_FALSE(mapper.take_second_query()) << "nothing was corrected";
  LoopAnswer answer = find_closures(*last);
  ASSERT_EQ(answer.candidates.at(0).rejection, LoopRejection::kNone);
  answer.candidates[0].edge.T_from_to = answer.candidates[0].edge.T_from_to * Se2{0.0, 0.5, 0.0};
  ASSERT_GE(mapper.apply(answer).accepted, 1);
  (void)mapper.optimise();
  std::vector<std::size_t> asked;
  int closures = 0;
  for (std::size_t i = 0; i < mapper.keyframes().size(); ++i) {
    const auto query = mapper.take_second_query();
    if (!query) continue;
    asked.push_back(query->node);
    const LoopAnswer again = find_closures(*query);
    closures += mapper.apply(again).accepted;
    const std::size_t edges = mapper.edges().size();
    (void)mapper.apply(again);
    EXPECT_EQ(mapper.edges().size(), edges) << "the same answer twice says nothing new";
  }
  EXPECT_GE(closures, 1);
  EXPECT_TRUE(std::is_sorted(asked.begin(), asked.end()));
  EXPECT_EQ(std::count(asked.begin(), asked.end(), last->node), 0) << "it has its closure";
}

TEST(Mapper, TheSameInputGivesTheSamePosesToTheBit) {
  const auto truth = drive({{1.2, 1.2}, {22.8, 1.2}, {22.8, 8.0}});
  const Trial a = run(mocks::ring_corridor(), truth, {}, 3), b = run(mocks::ring_corridor(), truth, {}, 3);
  EXPECT_EQ(a.estimate, b.estimate);
}

TEST(Mapper, StandingStillMakesNoKeyframes) {
  const mocks::FlatWorld world = mocks::two_rooms();
  std::mt19937 random(4);
  Mapper mapper({});
  walls::ColumnCollector columns({});
  for (int i = 0; i < 100; ++i)
    (void)mapper.add(testing::view_of(world, {3.0, 3.0, 0.2}, 0.02, random).cloud, {}, columns);
  EXPECT_EQ(mapper.keyframes().size(), 1U);
}

/// Keyframes of a robot that stands, before which a mate stood for a while.
std::size_t keyframes_beside_a_mate(double share_behind_it) {
  const mocks::FlatWorld world = mocks::two_rooms();
  std::mt19937 random(4);
  Mapper mapper({});
  walls::ColumnCollector columns({});
  for (int i = 0; i < 40; ++i) {
    Cloud cloud = testing::view_of(world, {3.0, 3.0, 0.2}, 0.02, random).cloud;
    cloud.invalid_share = i < 20 ? share_behind_it : 0.0;
    (void)mapper.add(cloud, {}, columns);
  }
  return mapper.keyframes().size();
}

TEST(Mapper, WhoStoodBehindAMateLooksOnceAgainWhenThatOneIsGone) {
  EXPECT_EQ(keyframes_beside_a_mate(0.08), 2U);
  EXPECT_EQ(keyframes_beside_a_mate(0.02), 1U) << "beams fail now and then";
}

TEST(Mapper, TurningOnTheSpotMakesFewKeyframes) {
  const auto keyframes_after = [](int turns) {
    std::mt19937 random(1);
    const MapperParams params;
    Mapper mapper(params);
    walls::ColumnCollector columns(params.coronal);
    const mocks::FlatWorld world = mocks::two_rooms();
    constexpr int kViews = 24;  // a turn
    for (int i = 0; i < turns * kViews; ++i) {
      const double turned_rad = types::wrap_angle(2.0 * M_PI * i / kViews);
      const testing::View view = testing::view_of(world, {2.0, 2.0, turned_rad}, 0.02, random);
      EXPECT_TRUE(mapper.add(view.cloud, {0.0, 0.0, turned_rad}, columns).matched) << i;
    }
    return mapper.keyframes().size();
  };
  const std::size_t some = keyframes_after(6);
  EXPECT_GT(some, 30U);
  EXPECT_LE(some, 80U);
  EXPECT_EQ(keyframes_after(20), some);
}

/// What the coronal laser sees while the robot turns would wait for a keyframe, in an odometry that drifts.
TEST(Mapper, ColumnsOfATurnThatMakesNoKeyframeAreForgotten) {
  std::mt19937 random(1);
  const MapperParams params;
  Mapper mapper(params);
  walls::ColumnCollector columns(params.coronal);
  const mocks::FlatWorld world = mocks::two_rooms();
  types::Scan coronal;
  coronal.geometry.angle_min_rad = static_cast<float>(-0.5 * M_PI);
  coronal.geometry.angle_increment_rad = static_cast<float>(M_PI);
  coronal.geometry.range_max_m = 30.0F;
  coronal.beams = 2;
  coronal.range_m[0] = coronal.range_m[1] = 3.0F;
  constexpr int kViews = 24;  // a turn
  std::size_t keyframes = 0;
  for (int i = 0; i < 12 * kViews; ++i) {
    const double turned_rad = types::wrap_angle(2.0 * M_PI * i / kViews);
    const types::Se2 T_odom_base{0.002 * i, 0.0, turned_rad};
    columns.add(coronal, T_odom_base, T_odom_base);
    (void)mapper.add(testing::view_of(world, {2.0, 2.0, turned_rad}, 0.02, random).cloud, T_odom_base,
                     columns);
    keyframes = mapper.keyframes().size();
  }
  EXPECT_GT(keyframes, 30U);
  EXPECT_LE(columns.take({}).size(), 2U * 3U) << "those of the views since it was last time for a keyframe";
}

TEST(Mapper, BlindScansAreCarriedByOdometry) {
  const mocks::FlatWorld world = mocks::two_rooms();
  std::mt19937 random(5);
  Mapper mapper({});
  walls::ColumnCollector columns({});
  (void)mapper.add(testing::view_of(world, {3.0, 3.0, 0.0}, 0.02, random).cloud, {}, columns);
  Cloud blind;
  const MatchReport report = mapper.add(blind, {0.1, 0.0, 0.0}, columns);
  EXPECT_FALSE(report.matched);
  EXPECT_NEAR(report.T_map_base.x_m, 0.1, 1e-12);
}

/// A drive at 1 m/s, and odometry that is set to its origin, 60 m away, in its middle.
TEST(Mapper, GoesOnWhereOdometryIsSetToAnotherPlace) {
  const mocks::FlatWorld world = mocks::two_rooms();
  const auto truth = drive({{1.5, 1.5}, {5.0, 1.5}, {5.0, 3.6}, {9.0, 3.6}});
  std::mt19937 random(8);
  Mapper mapper({}, {}, truth.front());
  walls::ColumnCollector columns({});
  const Se2 elsewhere{60.0, -10.0, 2.0};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    testing::View view = testing::view_of(world, truth[i], 0.02, random);
    view.cloud.stamp = types::stamp_from_seconds(0.1 * static_cast<double>(i));
    const Se2 odometry = i < truth.size() / 2 ? truth[i] : elsewhere * truth[i];
    const MatchReport report = mapper.add(view.cloud, odometry, columns);
    EXPECT_TRUE(report.matched) << i;
    EXPECT_LT((report.T_map_base.translation() - truth[i].translation()).norm(), 0.05) << i;
  }
}

/// A turn while driving, and odometry that says nothing for a second and then everything at once.
TEST(Mapper, OdometryThatWasHeldUpIsNotFollowedASecondTime) {
  const mocks::FlatWorld world = mocks::two_rooms();
  std::vector<Se2> truth{{3.0, 3.0, 0.0}};
  while (truth.size() < 12) truth.push_back(truth.back() * Se2{0.08, 0.0, 0.2});
  constexpr std::size_t kFirst = 4, kLast = 8;
  std::mt19937 random(9);
  Mapper mapper({}, {}, truth.front());
  walls::ColumnCollector columns({});
  for (std::size_t i = 0; i < truth.size(); ++i) {
    testing::View view = testing::view_of(world, truth[i], 0.02, random);
    view.cloud.stamp = types::stamp_from_seconds(0.2 * static_cast<double>(i));
    const Se2 odometry = truth[i >= kFirst && i <= kLast ? kFirst : i];
    const MatchReport report = mapper.add(view.cloud, odometry, columns);
    EXPECT_TRUE(report.matched) << i;
    EXPECT_LT((report.T_map_base.translation() - truth[i].translation()).norm(), 0.05) << i;
    EXPECT_LT(std::abs(types::wrap_angle(report.T_map_base.theta_rad - truth[i].theta_rad)), 0.03) << i;
  }
}

/// Where the robot is said to be when it moved so between two scans, and odometry heard something else.
MatchReport moved_as_heard(const mocks::FlatWorld& world, const Se2& pose, const Se2& moved,
                           const Se2& heard) {
  std::mt19937 random(6);
  Mapper mapper({}, {}, pose);
  walls::ColumnCollector columns({});
  (void)mapper.add(testing::view_of(world, pose, 0.02, random).cloud, {}, columns);
  return mapper.add(testing::view_of(world, pose * moved, 0.02, random).cloud, heard, columns);
}

/// The same of a robot that was turned on the spot, and no wheel moved.
MatchReport turned_unheard(const mocks::FlatWorld& world, const Se2& pose, double turn_rad) {
  return moved_as_heard(world, pose, {0.0, 0.0, turn_rad}, {});
}

TEST(Mapper, FindsItsHeadingAfterATurnThatOdometryDidNotHear) {
  const MatchReport report = turned_unheard(mocks::two_rooms(), {3.0, 3.0, 0.0}, 1.4);
  EXPECT_TRUE(report.matched);
  EXPECT_NEAR(report.T_map_base.theta_rad, 1.4, 0.02);
  EXPECT_NEAR(report.T_map_base.x_m, 3.0, 0.03);
}

TEST(Mapper, FindsItselfWhenOdometryHasTheWrongSense) {
  const MatchReport report =
      moved_as_heard(mocks::two_rooms(), {3.0, 3.0, 0.0}, {-0.8, 0.0, 0.1}, {0.8, 0.0, 0.1});
  EXPECT_TRUE(report.matched);
  EXPECT_NEAR(report.T_map_base.x_m, 2.2, 0.03);
  EXPECT_NEAR(report.T_map_base.y_m, 3.0, 0.03);
}

/// Ends of beams on two walls that meet in a corner, all seen from the origin turned by an angle.
Cloud corner_turned_by(double turn_rad) {
  const Se2 turned{0.0, 0.0, turn_rad};
  Cloud cloud;
  const auto add = [&](double x, double y) {
    cloud.points.push_back((turned * types::Vector2(x, y)).cast<float>());
    cloud.spacing_m.push_back(0.05F);
  };
  for (int i = 0; i <= 60; ++i) add(3.0, -1.5 + 0.05 * i);
  for (int i = 1; i <= 30; ++i) add(3.0 - 0.05 * i, 1.5);
  return cloud;
}

TEST(Mapper, FollowsOdometryOntoGroundThatNobodySaw) {
  Mapper mapper({});
  walls::ColumnCollector columns({});
  (void)mapper.add(corner_turned_by(0.0), {}, columns);
  const MatchReport report = mapper.add(corner_turned_by(2.0), {}, columns);
  EXPECT_FALSE(report.matched) << "a corner of the same form, where the first look did not reach";
  EXPECT_NEAR(report.T_map_base.theta_rad, 0.0, 1e-9);
}

TEST(Mapper, FollowsOdometryWhereTwoHeadingsFit) {
  mocks::FlatWorld hall;
  hall.box(0.0, 0.0, 12.0, 5.0);  // the same after half a turn
  const MatchReport report = turned_unheard(hall, {6.0, 2.5, 0.0}, 1.2);
  EXPECT_FALSE(report.matched);
  EXPECT_NEAR(report.T_map_base.theta_rad, 0.0, 1e-12);
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/session.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/slam/found_relations.hpp"
#include "core/slam/localise.hpp"
#include "core/slam/mapper.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

constexpr Se2 kStart{1.5, 1.5, 0.0};

/// Drives on from a true pose to another in small steps, with true odometry that began at `odom_start`.
void drive(Mapper& mapper, const mocks::FlatWorld& world, const Se2& from, const Se2& to,
           const Se2& odom_start, std::mt19937& random) {
  walls::ColumnCollector columns({});
  const int steps = static_cast<int>((to.translation() - from.translation()).norm() / 0.1) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Se2 pose = types::interpolate(from, to, static_cast<double>(i) / steps);
    (void)mapper.add(testing::view_of(world, pose, 0.01, random).cloud, odom_start.inverse() * pose, columns);
  }
}

Session first_room(const mocks::FlatWorld& world, std::mt19937& random) {
  Mapper mapper({});
  drive(mapper, world, kStart, {5.0, 1.5, 0.0}, kStart, random);
  drive(mapper, world, {5.0, 1.5, 0.0}, {5.0, 3.6, 0.0}, kStart, random);
  return mapper.session();
}

TEST(Resume, GoesOnMappingInTheSameFrameWithNewNumbers) {
  const mocks::FlatWorld world = mocks::two_rooms();
  std::mt19937 random(1);
  const Session session = first_room(world, random);
  const std::size_t before = session.keyframes.size();
  // Switched off, carried across the room, and odometry begins anew.
  const Se2 restart{5.5, 3.6, 0.3};
  const auto view = testing::view_of(world, restart, 0.01, random);
  const Localisation found = localise_anywhere(session, view.cloud, {});
  ASSERT_TRUE(found.found()) << describe(found);
  Mapper mapper({});
  mapper.resume(session, {view.cloud, {}, found.match.T_map_base, found.match.scan_information});
  ASSERT_EQ(mapper.keyframes().size(), before + 1);
  drive(mapper, world, restart, {9.0, 3.6, 0.3}, restart, random);
  drive(mapper, world, {9.0, 3.6, 0.3}, {9.0, 6.0, 0.3}, restart, random);
  const Se2 truth = kStart.inverse() * Se2{9.0, 6.0, 0.3};
  EXPECT_LT((mapper.T_map_base().translation() - truth.translation()).norm(), 0.06);
  ASSERT_GT(mapper.keyframes().size(), before + 5);
  for (std::size_t i = 0; i < mapper.keyframes().size(); ++i) {
    EXPECT_EQ(mapper.keyframes()[i]->id.sequence, i) << "no number comes twice";
    if (i < before) {
      EXPECT_EQ(mapper.keyframes()[i], session.keyframes[i]);
    }
  }
  EXPECT_TRUE(check_session(mapper.session()));
  // One graph: nothing hangs in the air, and solving it moves nothing.
  const Se2 at = mapper.T_map_base();
  EXPECT_TRUE(mapper.optimise().solved);
  EXPECT_LT((mapper.T_map_base().translation() - at.translation()).norm(), 0.02);
}

// What a robot found is in its session under the finder's number: a restart tells a team nothing twice.
TEST(Resume, FindsNothingOnceMoreThatHasAFinder) {
  const mocks::FlatWorld world = mocks::two_rooms();
  std::mt19937 random(3);
  Mapper first({}, {1, 11});
  drive(first, world, kStart, {5.0, 1.5, 0.0}, kStart, random);
  const Session session = first.session();
  const auto told = first.found_since(0);
  ASSERT_GT(told.size(), 4U);
  const auto kept = found_relations(session.keyframes, session.edges);
  ASSERT_EQ(kept.size(), told.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i].id, told[i].id);
    EXPECT_EQ(kept[i].key, told[i].key);
    EXPECT_EQ(kept[i].relation.T_from_to, told[i].relation.T_from_to);
  }
  const auto view = testing::view_of(world, {5.0, 1.5, 0.0}, 0.01, random);
  const Arrival arrival{view.cloud, {}, first.T_map_base(), Eigen::Matrix3d::Identity() * 1e4};
  Mapper second({}, {1, 22}), third({}, {1, 33}), again({}, {1, 11});
  second.resume(session, arrival);
  third.resume(second.session(), arrival);
  for (const Mapper* mapper : {&second, &third}) {
    ASSERT_EQ(mapper->found_since(0).size(), 1U) << "where it arrived";
    EXPECT_EQ(mapper->found_since(0).front().id.origin(), mapper->origin());
  }
  EXPECT_EQ(found_relations(third.keyframes(), third.edges()).size(), told.size() + 2U);
  again.resume(session, arrival);
  ASSERT_EQ(again.found_since(0).size(), 1U);
  EXPECT_EQ(again.found_since(0).front().id.sequence, told.size()) << "no number comes twice";
  EXPECT_TRUE(again.found_since(static_cast<std::uint32_t>(told.size()) + 1).empty());
  Session nameless = session;
  for (Edge& edge : nameless.edges) edge.finder = {};
  Mapper fourth({}, {1, 44});
  fourth.resume(nameless, arrival);
  EXPECT_EQ(fourth.found_since(0).size(), told.size() + 1U) << "else the team would never get them";
}

// The first scans after a resume see another part of the room than the session's last keyframes.
TEST(Resume, TracksAgainstWhatWasMappedThereBefore) {
  const mocks::FlatWorld world = mocks::two_rooms();
  std::mt19937 random(2);
  const Session session = first_room(world, random);
  const Se2 restart{1.5, 3.0, 1.2};
  const auto view = testing::view_of(world, restart, 0.01, random);
  Mapper mapper({});
  mapper.resume(session, {view.cloud, {}, kStart.inverse() * restart, Eigen::Matrix3d::Identity() * 1e4});
  walls::ColumnCollector columns({});
  const auto next = testing::view_of(world, {1.6, 3.1, 1.2}, 0.01, random);
  const MatchReport report = mapper.add(next.cloud, restart.inverse() * Se2{1.6, 3.1, 1.2}, columns);
  EXPECT_TRUE(report.matched);
  EXPECT_GT(report.match.overlap, 0.9);
}

TEST(CheckSession, NamesTheFirstFault) {
  const mocks::FlatWorld world = mocks::two_rooms();
  std::mt19937 random(3);
  const Session good = first_room(world, random);
  EXPECT_TRUE(check_session(good));
  EXPECT_TRUE(check_session({}));
  Session wrong = good;
  wrong.poses.pop_back();
  EXPECT_FALSE(check_session(wrong));
  wrong = good;
  wrong.keyframes[2] = nullptr;
  EXPECT_EQ(check_session(wrong).error().message, "keyframe 2 is missing");
  wrong = good;
  wrong.poses[1].theta_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(check_session(wrong));
  for (const auto spoil : {+[](Edge& e) { e.to = 1000; }, +[](Edge& e) { e.from = e.to; },
                           +[](Edge& e) { e.T_from_to.x_m = 1e9; },
                           +[](Edge& e) { e.information(0, 0) = std::numeric_limits<double>::infinity(); }}) {
    wrong = good;
    spoil(wrong.edges[3]);
    EXPECT_FALSE(check_session(wrong));
  }
}

}  // namespace
}  // namespace topo::slam

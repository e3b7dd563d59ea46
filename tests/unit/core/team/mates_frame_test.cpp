// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/mates_frame.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>

namespace topo::team {
namespace {

types::Se2 any_pose() {
  return {0.01 * *rc::gen::inRange(-5000, 5000), 0.01 * *rc::gen::inRange(-5000, 5000),
          0.01 * *rc::gen::inRange(-314, 314)};
}

StatusMessage mate_with(std::vector<Anchor> anchors) {
  StatusMessage mate;
  mate.robot = 2;
  mate.anchors = std::move(anchors);
  return mate;
}

PoseOf in_map(const std::map<slam::KeyframeId, types::Se2>& map) {
  return [&map](const slam::KeyframeId& id) {
    const auto at = map.find(id);
    return at == map.end() ? std::nullopt : std::optional(at->second);
  };
}

bool are_near(const types::Se2& a, const types::Se2& b) {
  return (a.translation() - b.translation()).norm() < 1e-6 &&
         std::abs(types::wrap_angle(a.theta_rad - b.theta_rad)) < 1e-9;
}

TEST(MatesFrame, IsWhereASharedKeyframeHasIt) {
  EXPECT_TRUE(rc::check([] {
    const types::Se2 T_own_mates = any_pose(), T_mates_first = any_pose(), T_mates_late = any_pose();
    const StatusMessage mate = mate_with({{5, 0, T_mates_first}, {5, 40, T_mates_late}});
    const bool has_late = *rc::gen::arbitrary<bool>();
    std::map<slam::KeyframeId, types::Se2> map{{{2, 0, 5}, T_own_mates * T_mates_first}};
    if (has_late) map[{2, 40, 5}] = T_own_mates * T_mates_late;
    const auto found = mates_frame(mate, *rc::gen::arbitrary<bool>(), in_map(map));
    RC_ASSERT(found.has_value());
    RC_ASSERT(are_near(*found, T_own_mates));
  }));
}

TEST(MatesFrame, IsByTheLatestSharedKeyframe) {
  const StatusMessage mate = mate_with({{5, 0, {0.0, 0.0, 0.0}}, {5, 40, {9.0, 0.0, 0.0}}});
  // The map has bent: the late keyframe lies half a metre off.
  const std::map<slam::KeyframeId, types::Se2> map{{{2, 0, 5}, {1.0, 0.0, 0.0}},
                                                   {{2, 40, 5}, {10.5, 0.0, 0.0}}};
  EXPECT_NEAR(mates_frame(mate, false, in_map(map))->x_m, 1.5, 1e-9);
}

TEST(MatesFrame, KeyframesOfAnotherRobotOrRunSayNothing) {
  const StatusMessage mate = mate_with({{5, 0, {}}});
  const std::map<slam::KeyframeId, types::Se2> map{{{3, 0, 5}, {}}, {{2, 0, 6}, {}}, {{2, 1, 5}, {}}};
  EXPECT_FALSE(mates_frame(mate, true, in_map(map)));
}

TEST(MatesFrame, IsTheCommonOneWhenBothStartedInIt) {
  StatusMessage mate = mate_with({});
  EXPECT_FALSE(mates_frame(mate, true, in_map({})));
  mate.in_common_frame = true;
  EXPECT_FALSE(mates_frame(mate, false, in_map({})));
  EXPECT_TRUE(are_near(*mates_frame(mate, true, in_map({})), {}));
}

TEST(RelationOfStarts, IsTheSameForBothRobots) {
  EXPECT_TRUE(rc::check([] {
    const types::Se2 start_a = any_pose(), start_b = any_pose();
    StatusMessage a = mate_with({{7, 0, start_a}}), b = mate_with({{5, 0, start_b}});
    a.robot = 1;
    a.in_common_frame = b.in_common_frame = true;
    const auto one = relation_of_starts(a, b), other = relation_of_starts(b, a);
    RC_ASSERT(one.has_value() && other.has_value());
    RC_ASSERT(one->first == other->first);
    RC_ASSERT(are_near(one->second.T_from_to, other->second.T_from_to));
    RC_ASSERT(are_near(start_a * one->second.T_from_to, start_b));
  }));
}

TEST(RelationOfStarts, NeedsTwoKnownStarts) {
  StatusMessage a = mate_with({{7, 0, {}}}), b = mate_with({{5, 0, {}}});
  a.robot = 1;
  EXPECT_FALSE(relation_of_starts(a, b)) << "nobody knows";
  a.in_common_frame = true;
  EXPECT_FALSE(relation_of_starts(a, b)) << "one does not know";
  b.in_common_frame = true;
  EXPECT_TRUE(relation_of_starts(a, b));
  b.anchors.front().sequence = 3;
  EXPECT_FALSE(relation_of_starts(a, b)) << "that keyframe is not at the start";
  b.anchors.clear();
  EXPECT_FALSE(relation_of_starts(a, b)) << "no keyframe yet";
}

}  // namespace
}  // namespace topo::team

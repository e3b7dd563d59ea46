// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/loop_closure.hpp"

#include <gtest/gtest.h>

#include "core/slam/make_keyframe.hpp"
#include "tests/unit/core/slam/keyframe_sample.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// What of the left room another visit knows: all up to this place.
constexpr float kKnown_m = 5.5F;

KeyframePtr keyframe_at(const Se2& pose, std::mt19937& random) {
  const testing::View view = testing::view_of(mocks::two_rooms(), pose, 0.01, random);
  return make_keyframe({}, view.cloud, view.points, {}, {}, {});
}

/// A keyframe that knows a part of the room, given in map axes (it stands there unturned); where it knows
/// nothing, it looked further than the walls are, or not at all.
KeyframePtr partly_seen(const Keyframe& whole, const Se2& pose, bool looked_further) {
  auto part = std::make_shared<Keyframe>(whole);
  const auto is_unknown = [&](const Point& p) { return p.x() + static_cast<float>(pose.x_m) > kKnown_m; };
  KeyframeContent content = testing::decoded(whole.content);
  std::erase_if(content.surfels, [&](const Surfel& surfel) { return is_unknown(surfel.position); });
  if (looked_further) {
    for (Point& p : content.match_points) p *= is_unknown(p) ? 1.5F : 1.0F;
  } else {
    std::erase_if(content.match_points, is_unknown);
  }
  part->content = CodedContent(std::move(content));
  return part;
}

LoopCandidate closure(double window_half_m, bool looked_further) {
  std::mt19937 random(1);
  LoopGroup group;
  for (const double y : {2.0, 2.5, 3.0, 3.5}) {
    group.poses.push_back({2.0, y, 0.0});
    group.keyframes.push_back(
        partly_seen(*keyframe_at(group.poses.back(), random), group.poses.back(), looked_further));
  }
  group.reference_pose = group.poses.front();
  group.window = {window_half_m, 0.15};
  LoopQuery query;
  query.node = 1;
  query.keyframe = keyframe_at({2.4, 2.8, 0.0}, random);
  query.pose = {2.6, 2.7, 0.03};  // drifted
  query.groups.push_back(group);
  return find_closures(query).candidates.front();
}

TEST(FindClosures, TakesAPartOfTheScanWhereNothingSpeaksAgainstThePlace) {
  const LoopCandidate candidate = closure(0.8, false);
  EXPECT_LT(candidate.response, LoopGateParams{}.response_min)
      << "too little for a match that must stand alone";
  EXPECT_EQ(candidate.rejection, LoopRejection::kNone);
  EXPECT_NEAR(candidate.edge.T_from_to.x_m, 0.4, 0.03);
  EXPECT_NEAR(candidate.edge.T_from_to.y_m, 0.8, 0.03);
  EXPECT_NEAR(candidate.edge.T_from_to.theta_rad, 0.0, 0.01);
}

TEST(FindClosures, RefusesAMatchThatContradictsSeenGround) {
  EXPECT_EQ(closure(0.8, true).rejection, LoopRejection::kLowResponse);
}

TEST(FindClosures, WantsMoreOfTheScanWhereNoDriftIsToBeMended) {
  EXPECT_EQ(closure(0.4, false).rejection, LoopRejection::kLowResponse);
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/make_keyframe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/slam/keyframe_codec.hpp"
#include "core/slam/wall_direction.hpp"
#include "tests/unit/core/slam/keyframe_sample.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

const KeyframeId kFrozenId{3, 17, 2};
const types::Se2 kFrozenOdometry{12.25, -3.5, 0.75};
const std::vector<walls::ColumnPoint> kFrozenColumns{{1.0F, 2.0F, 5U}, {-3.0F, 0.3F, 9U}};

testing::View frozen_view(unsigned seed) {
  std::mt19937 random(seed);
  testing::View view = testing::view_of(mocks::two_rooms(), {4.0, 3.0, 0.3}, 0.02, random);
  view.cloud.stamp = types::stamp_from_seconds(12.5);
  view.cloud.sensor = Point(0.25F, 0.0F);
  return view;
}

KeyframePtr frozen(const testing::View& view) {
  return make_keyframe(kFrozenId, view.cloud, view.points, kFrozenOdometry, kFrozenColumns, {});
}

void expect_near(std::span<const Point> rounded, std::span<const Point> exact) {
  ASSERT_EQ(rounded.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i)
    EXPECT_LE((rounded[i] - exact[i]).lpNorm<Eigen::Infinity>(), 0.501F * kPositionQuantum_m) << i;
}

TEST(MakeKeyframe, KnowsItsWallsAsWhoeverReceivesItDoes) {
  const KeyframePtr keyframe = frozen(frozen_view(1));
  ASSERT_TRUE(keyframe->walls_rad);
  // The rooms' walls lie along map's axes, and the robot is turned by 0.3 rad against them.
  EXPECT_NEAR(types::within_quarter(*keyframe->walls_rad + 0.3), 0.0, 0.01);
  const auto received = decode_keyframe(encode_keyframe(*keyframe));
  ASSERT_TRUE(received);
  EXPECT_EQ(received->walls_rad, keyframe->walls_rad);
}

TEST(MakeKeyframe, HoldsTheScanInItsOrder) {
  const testing::View view = frozen_view(1);
  const KeyframePtr keyframe = frozen(view);
  EXPECT_EQ(keyframe->id, kFrozenId);
  EXPECT_EQ(keyframe->stamp, view.cloud.stamp);
  EXPECT_EQ(keyframe->T_odom_base, kFrozenOdometry);
  EXPECT_EQ(keyframe->sensor, view.cloud.sensor);
  expect_near(keyframe->content.hits(), view.cloud.points);
  expect_near(keyframe->content.match_points(), view.points);
  const std::vector<Surfel> surfels = make_surfels(view.cloud, {});
  const std::vector<Surfel> kept = keyframe->content.surfels();
  ASSERT_EQ(kept.size(), surfels.size());
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    EXPECT_LE((kept[i].position - surfels[i].position).lpNorm<Eigen::Infinity>(),
              0.501F * kPositionQuantum_m);
    EXPECT_LT((kept[i].normal - surfels[i].normal).norm(), 1e-4F);
    EXPECT_EQ(kept[i].planar, surfels[i].planar);
  }
  const std::vector<walls::ColumnPoint> columns = keyframe->content.columns();
  ASSERT_EQ(columns.size(), kFrozenColumns.size());
  for (std::size_t i = 0; i < kFrozenColumns.size(); ++i) {
    EXPECT_EQ(columns[i].slabs, kFrozenColumns[i].slabs);
    EXPECT_NEAR(columns[i].x_m, kFrozenColumns[i].x_m, 0.001F);
  }
}

TEST(MakeKeyframe, IsWhatItsBytesGiveBack) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const KeyframePtr keyframe = frozen(frozen_view(seed));
    const auto back = decode_keyframe(encode_keyframe(*keyframe));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(testing::same(*back, *keyframe)) << "to the bit";
  }
}

TEST(MakeKeyframe, LeavesOutWhatIsNoEvidence) {
  testing::View view = frozen_view(2);
  const std::size_t hits = view.cloud.points.size(), points = view.points.size();
  for (const Point& wrong : {Point(kKeyframeReach_m + 1.0F, 0.0F), Point(0.0F, -200.0F),
                             Point(std::numeric_limits<float>::quiet_NaN(), 0.0F), Point(0.0F, HUGE_VALF)}) {
    view.points.insert(view.points.begin() + 3, wrong);
    view.cloud.points.push_back(wrong);
    view.cloud.spacing_m.push_back(0.0F);
  }
  const KeyframePtr keyframe = frozen(view);
  EXPECT_EQ(keyframe->content.hits().size(), hits);
  EXPECT_EQ(keyframe->content.match_points().size(), points);
}

TEST(MakeKeyframe, OfAnEmptyScanIsOneOfNothing) {
  const KeyframePtr keyframe = make_keyframe({1, 0}, {}, {}, {}, {}, {});
  EXPECT_TRUE(keyframe->content.hits().empty());
  EXPECT_TRUE(keyframe->content.surfels().empty());
  EXPECT_TRUE(keyframe->content.match_points().empty());
  EXPECT_TRUE(keyframe->content.columns().empty());
  EXPECT_TRUE(decode_keyframe(encode_keyframe(*keyframe)));
}

}  // namespace
}  // namespace topo::slam

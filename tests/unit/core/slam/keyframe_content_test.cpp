// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/keyframe_content.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "tests/unit/core/slam/keyframe_sample.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using testing::decoded;
using testing::random_content;

// What has been rounded once is rounded to itself: a map drawn by its robot and by a mate are one.
RC_GTEST_PROP(CodedContent, IsItsOwnRounding, (unsigned seed)) {
  std::mt19937 random(seed);
  const CodedContent coded(random_content(seed % 300, random));
  RC_ASSERT(CodedContent(decoded(coded)) == coded);
  const auto back = CodedContent::decode(coded.bytes());
  RC_ASSERT(back.has_value());
  RC_ASSERT(*back == coded);
  RC_ASSERT(back->hits() == coded.hits());
  RC_ASSERT(back->match_points() == coded.match_points());
}

RC_GTEST_PROP(CodedContent, KeepsAllInItsOrderAndRoundsWithinItsBounds, (unsigned seed)) {
  std::mt19937 random(seed);
  const KeyframeContent before = random_content(200, random);
  const CodedContent coded(before);
  const KeyframeContent after = decoded(coded);
  constexpr float kHalf_m = 0.5F * kPositionQuantum_m * 1.001F;
  const auto near = [](const Point& a, const Point& b) {
    return (a - b).lpNorm<Eigen::Infinity>() <= kHalf_m;
  };
  RC_ASSERT(std::ranges::equal(after.hits, before.hits, near));
  RC_ASSERT(std::ranges::equal(after.match_points, before.match_points, near));
  RC_ASSERT(after.surfels.size() == before.surfels.size());
  for (std::size_t i = 0; i < before.surfels.size(); ++i) {
    RC_ASSERT(near(after.surfels[i].position, before.surfels[i].position));
    RC_ASSERT(after.surfels[i].planar == before.surfels[i].planar);
    const float dot = after.surfels[i].normal.dot(before.surfels[i].normal);
    RC_ASSERT(std::abs(dot - 1.0F) < 1e-6F);
    RC_ASSERT((after.surfels[i].normal - before.surfels[i].normal).norm() < 4.9e-5F);
  }
  RC_ASSERT(after.columns.size() == before.columns.size());
  for (std::size_t i = 0; i < before.columns.size(); ++i) {
    RC_ASSERT(
        near({after.columns[i].x_m, after.columns[i].y_m}, {before.columns[i].x_m, before.columns[i].y_m}));
    RC_ASSERT(after.columns[i].slabs == before.columns[i].slabs);
  }
  RC_ASSERT(coded.beams() == before.hits.size() + before.columns.size());
}

TEST(CodedContent, OfNothingIsNothing) {
  const CodedContent nothing;
  EXPECT_TRUE(nothing.hits().empty());
  EXPECT_TRUE(nothing.match_points().empty());
  EXPECT_TRUE(nothing.surfels().empty());
  EXPECT_TRUE(nothing.columns().empty());
  EXPECT_EQ(nothing.beams(), 0U);
  EXPECT_TRUE(CodedContent::decode(nothing.bytes()));
  EXPECT_FALSE(CodedContent::decode({}));
}

// Match points that are no hits are kept too.
TEST(CodedContent, KeepsMatchPointsFromElsewhere) {
  std::mt19937 random(1);
  KeyframeContent content = random_content(60, random);
  content.match_points.emplace_back(1.0F, 2.0F);
  std::swap(content.match_points.front(), content.match_points.back());
  const CodedContent coded(content);
  ASSERT_EQ(coded.match_points().size(), content.match_points.size());
  EXPECT_EQ(coded.match_points().front(), Point(1.0F, 2.0F));
  EXPECT_TRUE(CodedContent::decode(coded.bytes()));
}

TEST(CodedContent, DropsWhatIsNoEvidence) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  KeyframeContent content;
  content.hits = {Point(1.0F, kNan), Point(2.0F, 0.5F), Point(500.0F, 0.0F),
                  Point(0.0F, -std::numeric_limits<float>::infinity())};
  content.surfels = {{Point(1.0F, 1.0F), Point(kNan, 0.0F), true},
                     {Point(1.0F, 1.0F), Point(0.0F, 1.0F), true}};
  const CodedContent coded(content);
  EXPECT_EQ(coded.hits(), std::vector<Point>{Point(2.0F, 0.5F)});
  EXPECT_EQ(coded.surfels().size(), 1U);
}

// A scan of 1081 beams: what a map keeps of it, and a session of the disk before it is packed.
TEST(CodedContent, TakesLessThanAThirdOfItsParts) {
  std::mt19937 random(4);
  const auto view = testing::view_of(mocks::two_rooms(), {3.0, 3.0, 0.3}, 0.02, random);
  const std::size_t parts =
      sizeof(Point) * (view.cloud.points.size() + view.points.size()) + sizeof(Surfel) * view.surfels.size();
  const std::size_t bytes = CodedContent({view.cloud.points, view.surfels, view.points, {}}).bytes().size();
  RecordProperty("bytes", static_cast<int>(bytes));
  EXPECT_LT(3 * bytes, parts);
}

}  // namespace
}  // namespace topo::slam

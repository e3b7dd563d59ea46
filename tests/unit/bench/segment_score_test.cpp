// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/segment_score.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace topo::bench {
namespace {

/// `value` from (x0, y0) to (x1 - 1, y1 - 1).
void fill(LabelPicture& picture, int x0, int y0, int x1, int y1, std::uint32_t value) {
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) picture.values[static_cast<std::size_t>(y * picture.width + x)] = value;
  }
}

LabelPicture blank(int width, int height) {
  return {width, height, false, std::vector<std::uint32_t>(static_cast<std::size_t>(width * height), 0)};
}

/// Two rooms of 20 x 20 pixels on both sides of a line.
LabelPicture drawn_rooms() {
  LabelPicture truth = blank(45, 24);
  fill(truth, 2, 2, 22, 22, 255);
  fill(truth, 23, 2, 43, 22, 255);
  return truth;
}

TEST(SegmentScore, OfTheTruthItselfIsOne) {
  const LabelPicture rooms = rooms_of(drawn_rooms());
  const auto s = score(rooms, rooms);
  ASSERT_TRUE(s.has_value());
  EXPECT_EQ(s->rooms, 2U);
  EXPECT_EQ(s->segments, 2U);
  for (const double value :
       {s->recall_micro, s->recall_macro, s->precision_micro, s->precision_macro, s->mcc})
    EXPECT_DOUBLE_EQ(value, 1.0);
}

/// By hand: one segment covers the first room and half of the second one, another the rest.
TEST(SegmentScore, CountsSharesAndCorrelation) {
  const LabelPicture rooms = rooms_of(drawn_rooms());
  LabelPicture segments = blank(45, 24);
  fill(segments, 2, 2, 22, 22, 7);
  fill(segments, 23, 2, 33, 22, 7);
  fill(segments, 33, 2, 43, 22, 9);
  const auto s = score(segments, rooms);
  ASSERT_TRUE(s.has_value());
  EXPECT_DOUBLE_EQ(s->recall_micro, (1.0 + 0.5) / 2);
  EXPECT_DOUBLE_EQ(s->recall_macro, 600.0 / 800.0);
  EXPECT_DOUBLE_EQ(s->precision_micro, (400.0 / 600.0 + 1.0) / 2);
  EXPECT_DOUBLE_EQ(s->precision_macro, 600.0 / 800.0);
  // 400 true, 200 false, none missed, 200 others; then 200 true, none false, 200 missed, 400 others.
  const double first = 400.0 * 200.0 / std::sqrt(600.0 * 400.0 * 400.0 * 200.0);
  const double second = 200.0 * 400.0 / std::sqrt(200.0 * 400.0 * 400.0 * 600.0);
  EXPECT_NEAR(s->mcc, (first + second) / 2, 1e-12);
}

TEST(SegmentScore, SmallOrUnmatchedSegmentsDoNotCount) {
  const LabelPicture rooms = rooms_of(drawn_rooms());
  LabelPicture segments = rooms;
  fill(segments, 2, 2, 12, 12, 5);  // 100 pixels
  const auto whole = score(segments, rooms);
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(whole->segments, 2U);
  fill(segments, 2, 2, 12, 13, 5);
  const auto parts = score(segments, rooms);
  ASSERT_TRUE(parts.has_value());
  EXPECT_EQ(parts->segments, 3U);
  EXPECT_LT(parts->mcc, 0.8);
}

TEST(SegmentScore, ColoursAreRoomsAndBlackIsNone) {
  LabelPicture truth = blank(30, 20);
  truth.coloured = true;
  fill(truth, 0, 0, 15, 20, 0x0A0B0C);
  fill(truth, 15, 0, 29, 20, 0x00FF00);
  fill(truth, 29, 0, 30, 20, 0x123456);  // 20 pixels
  const LabelPicture rooms = rooms_of(truth);
  EXPECT_EQ(*std::max_element(rooms.values.begin(), rooms.values.end()), 2U);
}

TEST(SegmentScore, LaysSmallerPicturesInTheMiddleAndTurnsThem) {
  LabelPicture truth = blank(64, 64), segments = blank(40, 40);
  truth.coloured = true;
  fill(truth, 12, 12, 32, 52, 1);    // left half
  fill(segments, 0, 20, 40, 40, 3);  // lower half: a quarter clockwise makes it the left one
  const auto turned = score(segments, rooms_of(truth), -std::numbers::pi / 2);
  ASSERT_TRUE(turned.has_value());
  EXPECT_GT(turned->recall_micro, 0.95);
  const auto as_it_is = score(segments, rooms_of(truth));
  ASSERT_TRUE(as_it_is.has_value());
  EXPECT_DOUBLE_EQ(as_it_is->recall_micro, 0.5);
  EXPECT_FALSE(score(blank(39, 40), rooms_of(truth)).has_value());
  EXPECT_FALSE(score(blank(70, 70), rooms_of(truth)).has_value());
}

TEST(LabelPicture, ComesBackAsItWasWritten) {
  LabelPicture labels = blank(300, 3);
  for (std::size_t i = 0; i < labels.values.size(); ++i)
    labels.values[i] = static_cast<std::uint32_t>(i * 72);
  const auto path = (std::filesystem::path(testing::TempDir()) / "label_picture_test.png").string();
  ASSERT_TRUE(save_labels(path, labels).has_value());
  const auto read = read_labels(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->values, labels.values);
  EXPECT_FALSE(read->coloured);
}

}  // namespace
}  // namespace topo::bench

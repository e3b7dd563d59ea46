// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/keyframe_codec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "core/types/bytes.hpp"
#include "tests/unit/core/slam/keyframe_sample.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using testing::random_keyframe;
using testing::same;

Keyframe quantised(Keyframe keyframe) {
  quantise(keyframe);
  return keyframe;
}

RC_GTEST_PROP(KeyframeCodec, WhatIsEncodedComesBackToTheBit, (unsigned seed)) {
  std::mt19937 random(seed);
  const Keyframe k = random_keyframe(seed % 1000, seed % 300, random);
  const auto bytes = encode_keyframe(k);
  const auto back = decode_keyframe(bytes);
  RC_ASSERT(back.has_value());
  RC_ASSERT(same(*back, quantised(k)));
  RC_ASSERT(encode_keyframe(*back) == bytes);
  RC_ASSERT(same(quantised(*back), *back));
}

RC_GTEST_PROP(KeyframeCodec, RoundingStaysWithinItsBounds, (unsigned seed)) {
  std::mt19937 random(seed);
  const Keyframe before = random_keyframe(0, 200, random), after = quantised(before);
  RC_ASSERT(after.hits.size() == before.hits.size());
  constexpr float kHalf_m = 0.5F * kPositionQuantum_m * 1.001F;
  for (std::size_t i = 0; i < before.hits.size(); ++i)
    RC_ASSERT((after.hits[i] - before.hits[i]).lpNorm<Eigen::Infinity>() <= kHalf_m);
  for (std::size_t i = 0; i < before.surfels.size(); ++i) {
    RC_ASSERT((after.surfels[i].position - before.surfels[i].position).lpNorm<Eigen::Infinity>() <= kHalf_m);
    const float dot = after.surfels[i].normal.dot(before.surfels[i].normal);
    RC_ASSERT(std::abs(dot - 1.0F) < 1e-6F);
    RC_ASSERT((after.surfels[i].normal - before.surfels[i].normal).norm() < 4.9e-5F);
  }
  for (std::size_t i = 0; i < before.columns.size(); ++i) {
    RC_ASSERT(std::abs(after.columns[i].x_m - before.columns[i].x_m) <= kHalf_m);
    RC_ASSERT(after.columns[i].slabs == before.columns[i].slabs);
  }
}

// Match points that are no hits are kept too.
TEST(KeyframeCodec, MatchPointsFromElsewhere) {
  std::mt19937 random(1);
  Keyframe k = random_keyframe(1, 60, random);
  k.match_points.emplace_back(1.0F, 2.0F);
  std::swap(k.match_points.front(), k.match_points.back());
  const auto back = decode_keyframe(encode_keyframe(k));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(same(*back, quantised(k)));
}

TEST(KeyframeCodec, DropsWhatIsNoEvidence) {
  Keyframe k;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  k.hits = {Point(1.0F, kNan), Point(2.0F, 0.5F), Point(500.0F, 0.0F),
            Point(0.0F, -std::numeric_limits<float>::infinity())};
  k.surfels = {{Point(1.0F, 1.0F), Point(kNan, 0.0F), true}, {Point(1.0F, 1.0F), Point(0.0F, 1.0F), true}};
  quantise(k);
  ASSERT_EQ(k.hits.size(), 1U);
  EXPECT_EQ(k.hits[0], Point(2.0F, 0.5F));
  EXPECT_EQ(k.surfels.size(), 1U);
}

TEST(KeyframeCodec, EveryCutIsRefused) {
  std::mt19937 random(2);
  const auto bytes = encode_keyframe(random_keyframe(7, 40, random));
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_FALSE(decode_keyframe(std::span(bytes).first(n))) << n;
  auto longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(decode_keyframe(longer));
}

// A flipped byte gives another keyframe or none, never bytes with two readings.
TEST(KeyframeCodec, EveryFlippedByteIsRefusedOrAnotherKeyframe) {
  std::mt19937 random(3);
  const auto bytes = encode_keyframe(random_keyframe(7, 40, random));
  std::size_t refused = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned mask : {0x01U, 0x80U, 0xFFU}) {
      auto damaged = bytes;
      damaged[i] ^= static_cast<std::byte>(mask);
      const auto back = decode_keyframe(damaged);
      if (back) {
        EXPECT_EQ(encode_keyframe(*back), damaged) << i;
      } else {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 0U);
}

TEST(KeyframeCodec, ACountIsNotBelieved) {
  types::ByteWriter out;
  const auto empty = encode_keyframe({});
  out.append(std::span(empty).first(empty.size() - 5));
  out.varint(std::uint64_t{1} << 60U);
  const auto refused = decode_keyframe(out.bytes());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, types::Errc::kProtocol);
}

TEST(KeyframeCodec, AnotherVersionIsNamed) {
  auto bytes = encode_keyframe({});
  bytes[0] = std::byte{3};
  const auto refused = decode_keyframe(bytes);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, types::Errc::kUnsupported);
  EXPECT_EQ(refused.error().message, "keyframe: found version 3, expected 1 or 2");
}

// A second run of one robot has its number in a form of its own: what the first version wrote stays as it is.
TEST(KeyframeCodec, ARunIsKept) {
  Keyframe k;
  k.id = {1, 2, 0x12345678};
  auto bytes = encode_keyframe(k);
  EXPECT_EQ(bytes[0], std::byte{2});
  const auto back = decode_keyframe(bytes);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->id, k.id);
  std::fill_n(bytes.begin() + 3, 4, std::byte{0});
  EXPECT_FALSE(decode_keyframe(bytes)) << "run 0 has one form";
}

// Version 1 stays readable: the bytes of a keyframe written down.
TEST(KeyframeCodec, TheFirstVersionsBytes) {
  Keyframe k;
  k.id = {1, 2};
  k.stamp = types::Stamp{types::Duration{3}};
  k.hits = {Point(1.0F, 0.5F), Point(1.0F, 0.25F)};
  k.match_points = {Point(1.0F, 0.25F)};
  k.surfels = {{Point(0.0F, -1.0F / 1024.0F), Point(0.0F, 1.0F), true}};
  k.columns = {{-1.0F / 1024.0F, 0.0F, 0x81}};
  const std::vector<int> expected{1, 1,    0,    2,    0,    0,    0,    3,    0, 0, 0, 0, 0, 0, 0,  // head
                                  0, 0,    0,    0,    0,    0,    0,    0,    0, 0, 0, 0, 0, 0, 0,
                                  0, 0,    0,    0,    0,    0,    0,    0,    0,  // pose
                                  0, 0,    0,    0,    0,    0,    0,    0,        // sensor
                                  2, 0x80, 0x10, 0,    0x80, 0x08, 0xFF, 0x03,     // hits
                                  1, 1,    1,                                      // match points
                                  1, 0,    1,    0x00, 0x40, 1,                    // surfels
                                  1, 1,    0,    0x81, 0x01};                      // columns
  std::vector<std::byte> bytes;
  for (const int b : expected) bytes.push_back(static_cast<std::byte>(b));
  EXPECT_EQ(encode_keyframe(k), bytes);
  const auto back = decode_keyframe(bytes);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(same(*back, quantised(k)));
}

// The keyframe of a scan of 1081 beams: what a session takes of the disk before it is packed.
TEST(KeyframeCodec, TakesLessThanAThirdOfTheMemory) {
  std::mt19937 random(4);
  const auto view = testing::view_of(mocks::two_rooms(), {3.0, 3.0, 0.3}, 0.02, random);
  Keyframe k;
  k.hits = view.cloud.points;
  k.match_points = view.points;
  k.surfels = view.surfels;
  quantise(k);
  const std::size_t memory =
      sizeof(Point) * (k.hits.size() + k.match_points.size()) + sizeof(Surfel) * k.surfels.size();
  const std::size_t bytes = encode_keyframe(k).size();
  RecordProperty("bytes", static_cast<int>(bytes));
  EXPECT_LT(3 * bytes, memory);
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/keyframe_codec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/types/bytes.hpp"
#include "tests/unit/core/slam/keyframe_sample.hpp"

namespace topo::slam {
namespace {

using testing::random_keyframe;
using testing::same;

RC_GTEST_PROP(KeyframeCodec, WhatIsEncodedComesBackToTheBit, (unsigned seed)) {
  std::mt19937 random(seed);
  const Keyframe k = random_keyframe(seed % 1000, seed % 300, random);
  const auto bytes = encode_keyframe(k);
  const auto back = decode_keyframe(bytes);
  RC_ASSERT(back.has_value());
  RC_ASSERT(same(*back, k));
  RC_ASSERT(encode_keyframe(*back) == bytes);
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
  KeyframeContent content;
  content.hits = {Point(1.0F, 0.5F), Point(1.0F, 0.25F)};
  content.match_points = {Point(1.0F, 0.25F)};
  content.surfels = {{Point(0.0F, -1.0F / 1024.0F), Point(0.0F, 1.0F), true}};
  content.columns = {{-1.0F / 1024.0F, 0.0F, 0x81}};
  k.content = CodedContent(content);
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
  EXPECT_TRUE(same(*back, k));
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/radio.hpp"

#include <gtest/gtest.h>

namespace topo::bench {
namespace {

const types::Vector2 kHere{0.0, 0.0}, kThere{16.0, 0.0}, kNear{14.9, 0.0};

int carried(const std::string& text, const types::Vector2& to, std::uint64_t seed = 1) {
  const auto params = parse_radio(text);
  EXPECT_TRUE(params.has_value()) << text;
  Radio radio(*params, seed);
  int count = 0;
  for (int i = 0; i < 1000; ++i) count += radio.carries(kHere, to) ? 1 : 0;
  return count;
}

TEST(Radio, carriesAllNothingOrWhatIsInRange) {
  EXPECT_EQ(carried("perfect", kThere), 1000);
  EXPECT_EQ(carried("none", kNear), 0);
  EXPECT_EQ(carried("range:15", kThere), 0);
  EXPECT_EQ(carried("range:15", kNear), 1000);
}

TEST(Radio, losesItsShareAndTheSameForTheSameSeed) {
  EXPECT_NEAR(carried("loss:0.3", kThere), 700, 50);
  EXPECT_EQ(carried("loss:0.3", kThere, 4), carried("loss:0.3", kThere, 4));
  EXPECT_EQ(carried("loss:0", kThere), 1000);
}

TEST(Radio, saysWhatWouldBeRight) {
  for (const char* text : {"", "range", "range:", "range:-1", "range:0", "loss:1", "loss:-0.1", "loss:0.3x",
                           "range:nan", "Perfect"}) {
    const auto params = parse_radio(text);
    ASSERT_FALSE(params.has_value()) << text;
    EXPECT_NE(params.error().message.find("found '" + std::string(text) + "'"), std::string::npos);
    EXPECT_NE(params.error().message.find("range:M"), std::string::npos);
  }
}

}  // namespace
}  // namespace topo::bench

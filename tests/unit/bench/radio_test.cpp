// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/radio.hpp"

#include <gtest/gtest.h>

namespace topo::bench {
namespace {

const types::Vector2 kHere{0.0, 0.0}, kThere{16.0, 0.0}, kNear{14.9, 0.0};

int carried(const std::string& text, const types::Vector2& to, std::uint64_t seed = 1, double now_s = 0.0) {
  const auto params = parse_radio(text);
  EXPECT_TRUE(params.has_value()) << text;
  Radio radio(*params, seed);
  int count = 0;
  for (int i = 0; i < 1000; ++i) count += radio.carries(kHere, to, now_s) ? 1 : 0;
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

TEST(Radio, isSilentWhileItIsCut) {
  for (const auto& [now_s, count] : {std::pair{119.9, 1000}, {120.0, 0}, {719.9, 0}, {720.0, 1000}})
    EXPECT_EQ(carried("cut:120:720", kNear, 1, now_s), count) << now_s;
}

TEST(Radio, joinsItemsByPlus) {
  EXPECT_NEAR(carried("loss:0.3+cut:120:720", kThere), 700, 50);
  EXPECT_EQ(carried("loss:0.3+cut:120:720", kThere, 1, 200.0), 0);
  EXPECT_EQ(carried("range:15+loss:0", kThere), 0);
  EXPECT_EQ(carried("cut:0:1+cut:5:6", kThere, 1, 5.5), 0);
  const auto params = parse_radio("range:20+delay:0.25");
  ASSERT_TRUE(params.has_value());
  EXPECT_EQ(params->delay_s, 0.25);
  EXPECT_EQ(params->range_m, 20.0);
}

TEST(Radio, saysWhatWouldBeRight) {
  for (const char* text :
       {"",          "range",     "range:",    "range:-1",  "range:0",  "loss:1",   "loss:-0.1",
        "loss:0.3x", "range:nan", "Perfect",   "cut:120",   "cut:",     "cut:5:5",  "cut:9:5",
        "cut:-1:5",  "cut:1:nan", "loss:0.3+", "+loss:0.3", "delay:-1", "delay:99", "loss:0.3,cut:1:2"}) {
    const auto params = parse_radio(text);
    ASSERT_FALSE(params.has_value()) << text;
    EXPECT_NE(params.error().message.find("found '" + std::string(text) + "'"), std::string::npos);
    EXPECT_NE(params.error().message.find("range:M"), std::string::npos);
  }
}

}  // namespace
}  // namespace topo::bench

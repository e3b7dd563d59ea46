// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/finish.hpp"

#include <gtest/gtest.h>

#include "core/exploration/params.hpp"

namespace topo::exploration {
namespace {

TEST(FinishRuleText, ReadsBackAsWritten) {
  for (const FinishRule& rule : {FinishRule{Finish::kEssential, 0.0}, FinishRule{Finish::kComplete, 0.0},
                                 FinishRule{Finish::kWorth, 0.1}, FinishRule{Finish::kWorth, kRateMin_m2ps},
                                 FinishRule{Finish::kWorth, kRateMax_m2ps}}) {
    const auto read = parse_finish(to_text(rule));
    ASSERT_TRUE(read) << to_text(rule);
    EXPECT_EQ(*read, rule) << to_text(rule);
  }
  EXPECT_EQ(to_text(FinishRule{Finish::kWorth, 0.25}), "worth:0.25");
}

TEST(FinishRuleText, WhatIsWrongIsNamedWithWhatIsRight) {
  for (const char* text : {"", "all", "worth", "worth:", "worth:x", "worth:0.1x", "worth:0", "worth:-1",
                           "worth:nan", "worth:inf", "worth:0.0009", "worth:10.1", "Complete", "complete "}) {
    const auto read = parse_finish(text);
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().message.find("found '" + std::string(text) + "'"), std::string::npos);
    EXPECT_NE(read.error().message.find(kFinishForm), std::string::npos);
  }
}

TEST(FinishRuleText, ARateIsThatOfWorthAlone) {
  ExplorationParams params;
  params.worth.rate_m2ps = 3.0;
  set_finish({Finish::kComplete, 0.0}, params);
  EXPECT_EQ(params.worth.rate_m2ps, 3.0);
  set_finish({Finish::kWorth, 0.5}, params);
  EXPECT_EQ(params.finish, Finish::kWorth);
  EXPECT_EQ(params.worth.rate_m2ps, 0.5);
}

}  // namespace
}  // namespace topo::exploration

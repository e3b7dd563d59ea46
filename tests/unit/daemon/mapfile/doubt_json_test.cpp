// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/doubt_json.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace topo::daemon {
namespace {

using slam::DoubtReason;
using ::testing::HasSubstr;

slam::MapDoubt doubted_for(DoubtReason reason) {
  slam::MapDoubt doubt;
  doubt.figure = 1.5;
  doubt.reason = reason;
  doubt.scans = {1006, 1005, 604};
  doubt.contradicted = 0.2;
  doubt.tension = 0.27;
  doubt.loose_rad = 0.1;
  doubt.loose_m = 1.26;
  return doubt;
}

TEST(DoubtText, SaysWhatSpeaksMostAgainstTheMap) {
  EXPECT_THAT(doubt_text(doubted_for(DoubtReason::kLost)), HasSubstr("lost in 1005 of 1006 scans"));
  EXPECT_THAT(doubt_text(doubted_for(DoubtReason::kContradicted)), HasSubstr("20 % of what was seen twice"));
  EXPECT_THAT(doubt_text(doubted_for(DoubtReason::kTension)), HasSubstr("27 % of the places"));
  EXPECT_THAT(doubt_text(doubted_for(DoubtReason::kLoose)), HasSubstr("to some 6 degrees"));
  EXPECT_THAT(doubt_text(doubted_for(DoubtReason::kShifted)),
              HasSubstr("how far the robot went, to some 1.3 m"));
  EXPECT_THAT(doubt_text(doubted_for(DoubtReason::kDegenerate)), HasSubstr("604 of 1006 scans leave"));
}

TEST(DoubtText, IsEmptyForAMapThatIsNotDoubted) {
  slam::MapDoubt doubt = doubted_for(DoubtReason::kLost);
  doubt.figure = 1.0;
  EXPECT_EQ(doubt_text(doubt), "");
}

TEST(DoubtJson, HasThePlaces) {
  slam::MapDoubt doubt = doubted_for(DoubtReason::kLoose);
  doubt.regions = {{{7.5, 2.5}, 2000, 600}};
  doubt.loose = {{{3.0, 4.0}, 0.1, 0.7}};
  const nlohmann::json json = doubt_json(doubt);
  EXPECT_DOUBLE_EQ(json["figure"], 1.5);
  EXPECT_EQ(json["why"], doubt_text(doubt));
  ASSERT_EQ(json["regions"].size(), 1U);
  EXPECT_DOUBLE_EQ(json["regions"][0]["x_m"], 7.5);
  EXPECT_DOUBLE_EQ(json["regions"][0]["contradicted"], 0.7);
  ASSERT_EQ(json["loose"].size(), 1U);
  EXPECT_DOUBLE_EQ(json["loose"][0]["x_m"], 3.0);
  EXPECT_DOUBLE_EQ(json["loose"][0]["y_m"], 4.0);
  EXPECT_DOUBLE_EQ(json["loose"][0]["sigma_m"], 0.7);
}

}  // namespace
}  // namespace topo::daemon

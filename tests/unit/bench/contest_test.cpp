// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/contest.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace topo::bench {
namespace {

const std::vector<std::string> kStrategies{"topometric", "topometric_no_walls", "min_pos",
                                           "nearest_frontier"};
const std::vector<std::string> kRadios{"perfect", "range:15"};

std::vector<Entrant> one_and_two() { return entrants_of(kStrategies, std::vector{1, 2}, kRadios); }

std::string error_of(const std::string& text) {
  const auto contest = parse_contest(text, one_and_two());
  EXPECT_FALSE(contest.has_value()) << text;
  return contest ? "" : contest.error().message;
}

TEST(Entrants, areAllCombinationsButOneRobotHasNoRadio) {
  const std::vector<Entrant> entrants = one_and_two();
  EXPECT_EQ(entrants.size(), kStrategies.size() * (1 + kRadios.size()));
  EXPECT_EQ(entrants.front(), (Entrant{"topometric", 1}));
  EXPECT_EQ(entrants.back(), (Entrant{"nearest_frontier", 2, "range:15"}));
  EXPECT_EQ(name_of(entrants.back()), "2 x nearest_frontier, range:15");
}

TEST(Contest, isReadFromText) {
  const auto contest = parse_contest("topometric:2/nearest_frontier:1", one_and_two());
  ASSERT_TRUE(contest.has_value()) << contest.error().message;
  EXPECT_EQ(contest->a, (Entrant{"topometric", 2, "perfect"})) << "the first radio";
  EXPECT_EQ(contest->b, (std::vector<Entrant>{{"nearest_frontier", 1}}));
  EXPECT_EQ(name_of_opponents(*contest), "1 x nearest_frontier");
}

TEST(Contest, canNameARadioThatHasAColonItself) {
  const auto contest = parse_contest("topometric:2:range:15/topometric:2:perfect", one_and_two());
  ASSERT_TRUE(contest.has_value()) << contest.error().message;
  EXPECT_EQ(contest->a, (Entrant{"topometric", 2, "range:15"}));
  EXPECT_EQ(contest->b, (std::vector<Entrant>{{"topometric", 2, "perfect"}}));
}

TEST(Contest, canBeAgainstTheBestBaselineWhichNoAblationIs) {
  const auto contest = parse_contest("topometric:1/best_baseline:2:range:15", one_and_two());
  ASSERT_TRUE(contest.has_value()) << contest.error().message;
  EXPECT_EQ(contest->b,
            (std::vector<Entrant>{{"min_pos", 2, "range:15"}, {"nearest_frontier", 2, "range:15"}}));
  EXPECT_EQ(name_of_opponents(*contest), "2 x best_baseline, range:15");
}

TEST(Contest, saysWhatItShouldBe) {
  for (const char* text : {"", "/", "topometric:2", "topometric/min_pos", "topometric:2/min_pos:",
                           ":2/min_pos:1", "topometric:two/min_pos:1", "topometric:2x/min_pos:1"})
    EXPECT_NE(error_of(text).find("expected STRATEGY:ROBOTS"), std::string::npos) << text;
  EXPECT_NE(error_of("topometric:3/min_pos:1").find("found topometric:3, which does not run"),
            std::string::npos);
  EXPECT_NE(error_of("topometric:2/greedy:1").find("found greedy:1, which does not run"), std::string::npos);
  EXPECT_NE(error_of("topometric:2:none/min_pos:2").find("does not run"), std::string::npos);
  EXPECT_NE(error_of("best_baseline:2/min_pos:2").find("expected one strategy"), std::string::npos);
}

TEST(UsualContests, holdTheFirstStrategyAgainstWhatMattersForIt) {
  const std::vector<Contest> contests = usual_contests(one_and_two());
  const auto has = [&](const Entrant& a, const std::vector<Entrant>& b) {
    return std::any_of(contests.begin(), contests.end(),
                       [&](const Contest& c) { return c.a == a && c.b == b; });
  };
  const Entrant alone{"topometric", 1}, two{"topometric", 2}, far{"topometric", 2, "range:15"};
  EXPECT_TRUE(has(alone, {{"min_pos", 1}}));
  EXPECT_TRUE(has(alone, {{"min_pos", 1}, {"nearest_frontier", 1}}));
  EXPECT_TRUE(has(two, {{"topometric_no_walls", 2}}));
  EXPECT_TRUE(has(two, {{"nearest_frontier", 1}}));
  EXPECT_TRUE(has(two, {alone}));
  EXPECT_TRUE(has(far, {{"min_pos", 2, "range:15"}}));
  EXPECT_TRUE(has(far, {two}));
  EXPECT_FALSE(has(far, {{"nearest_frontier", 1}}));
  EXPECT_FALSE(has(two, {two}));
  for (const Contest& contest : contests) {
    EXPECT_EQ(contest.a.strategy, "topometric");
    EXPECT_FALSE(contest.b.empty());
  }
}

TEST(UsualContests, haveNoBestOfOne) {
  const std::vector<std::string> strategies{"topometric", "min_pos"};
  EXPECT_EQ(usual_contests(entrants_of(strategies, std::vector{1}, kRadios)).size(), 1U);
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/goal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace topo::goals {
namespace {

TEST(Goal, EveryVerdictHasASentenceOfItsOwn) {
  std::set<std::string_view> sentences;
  for (int v = 0; v <= static_cast<int>(Verdict::kUnlikely); ++v)
    sentences.insert(to_text(static_cast<Verdict>(v)));
  EXPECT_EQ(sentences.size(), 6U);
  EXPECT_EQ(sentences.count(to_text(static_cast<Verdict>(200))), 0U) << "no verdict";
  EXPECT_EQ(std::ranges::count(sentences, std::string_view()), 0);
}

TEST(Goal, EverySideHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const Side side : {Side::kEast, Side::kNorth, Side::kWest, Side::kSouth, Side::kNone})
    names.insert(to_text(side));
  EXPECT_EQ(names, (std::set<std::string_view>{"east", "north", "west", "south", "none"}));
  EXPECT_EQ(to_text(Side::kEast), "east");
  EXPECT_EQ(to_text(Side::kWest), "west");
  EXPECT_EQ(to_text(Side::kSouth), "south");
}

TEST(Goal, ByDefaultItLeadsOnAndHasNoPlace) {
  const Goal goal;
  EXPECT_EQ(goal.behind_m2, HUGE_VAL);
  EXPECT_EQ(goal.place, 0U);
  EXPECT_EQ(goal.side, Side::kNone);
  EXPECT_EQ(goal.verdict, Verdict::kAccepted);
}

}  // namespace
}  // namespace topo::goals

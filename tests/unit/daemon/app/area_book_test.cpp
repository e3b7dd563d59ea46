// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/area_book.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;

const types::Polygon kStairs{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}};
const types::Polygon kGlass{{5.0, 5.0}, {6.0, 5.0}, {6.0, 6.0}};
const team::EntryId kMates{2, 3, 77};

TEST(AreaBook, DrawnAreasAreLimitsBesideTheConfigured) {
  AreaBook book;
  types::AreaLimits configured;
  configured.keep_out = {kGlass};
  EXPECT_EQ(book.with(configured), configured);
  EXPECT_EQ(book.draw(kStairs).value_or(""), "1");
  EXPECT_EQ(book.with(configured).keep_out, (std::vector<types::Polygon>{kGlass, kStairs}));
  ASSERT_EQ(book.wishes().own.size(), 1U);
  EXPECT_EQ(book.wishes().own.front().corners_map, kStairs);
  EXPECT_TRUE(book.withdraw("1").has_value());
  EXPECT_EQ(book.with(configured), configured);
  EXPECT_EQ(book.draw(kStairs).value_or(""), "2") << "no number is used again";
}

TEST(AreaBook, WhatIsNoAreaIsRefused) {
  AreaBook book;
  const auto why = [&](const types::Polygon& corners) {
    const auto drawn = book.draw(corners);
    return drawn ? std::string() : drawn.error().message;
  };
  EXPECT_THAT(why({{0.0, 0.0}, {1.0, 0.0}}), HasSubstr("three are needed"));
  EXPECT_THAT(why({{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}), HasSubstr("crosses"));
  EXPECT_THAT(why({{0.0, 0.0}, {1.0, 0.0}, {std::nan(""), 1.0}}), HasSubstr("corner 3"));
  EXPECT_THAT(why(types::Polygon(61, types::Vector2(0.0, 0.0))), HasSubstr("61"));
  EXPECT_TRUE(book.areas().empty());
  EXPECT_THAT(book.withdraw("1").error().message, HasSubstr("area list"));
}

TEST(AreaBook, AnAreaOfAFileWithoutAKindKeepsOut) {
  const std::string area = R"("number": 1, "corners_m": [[0, 0], [1, 0], [1, 1]])";
  const auto book = [&](const std::string& kind) {
    return AreaBook::parse(R"({"version": 1, "last": 1, "areas": [{)" + area + kind +
                           R"(}], "withdrawn": []})");
  };
  ASSERT_TRUE(book(""));
  EXPECT_EQ(book("")->with({}).keep_out.size(), 1U);
  ASSERT_TRUE(book(R"(, "kind": "here_first")"));
  EXPECT_TRUE(book(R"(, "kind": "here_first")")->with({}).keep_out.empty());
  EXPECT_EQ(book(R"(, "kind": "here_first")")->here_first().size(), 1U);
  EXPECT_FALSE(book(R"(, "kind": "other")"));
  EXPECT_FALSE(book(R"(, "kind": 1)"));
}

TEST(AreaBook, ThereIsABound) {
  AreaBook book({.areas = 2, .corners = 7});
  EXPECT_TRUE(book.draw(kStairs).has_value());
  EXPECT_THAT(book.draw({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.5, 2.0}, {0.0, 1.0}}).error().message,
              HasSubstr("withdraw one"));
  EXPECT_TRUE(book.draw(kGlass).has_value());
  EXPECT_FALSE(book.draw(kGlass).has_value());
  TeamAreas team;
  team.of_mates = {{kMates, kGlass}};
  EXPECT_FALSE(book.note(team));
  EXPECT_THAT(book.trouble(), HasSubstr("robot 2"));
}

TEST(AreaBook, AMatesAreaComesMovesAndGoes) {
  AreaBook book;
  TeamAreas team;
  team.of_mates = {{kMates, std::nullopt}};
  EXPECT_FALSE(book.note(team));
  EXPECT_THAT(book.trouble(), HasSubstr("where that robot's map lies"));
  team.of_mates.front().corners_map = kStairs;
  EXPECT_TRUE(book.note(team));
  EXPECT_FALSE(book.note(team)) << "nothing new";
  EXPECT_TRUE(book.trouble().empty());
  EXPECT_EQ(id_of(book.areas().front()), "2.77.3");
  EXPECT_TRUE(book.wishes().own.empty());
  team.of_mates.front().corners_map = kGlass;
  EXPECT_TRUE(book.note(team));
  EXPECT_EQ(book.areas().front().corners_map, kGlass);
  EXPECT_TRUE(book.note({{}, {kMates}, {}}));
  EXPECT_TRUE(book.areas().empty());
}

TEST(AreaBook, AMatesAreaThatIsNotHeardOfStays) {
  AreaBook book;
  EXPECT_TRUE(book.note({{{kMates, kStairs}}, {}, {}}));
  EXPECT_FALSE(book.note({}));
  EXPECT_FALSE(book.note({{{kMates, std::nullopt}}, {}, {}})) << "its place here is that of before";
  EXPECT_EQ(book.areas().size(), 1U);
  EXPECT_TRUE(book.trouble().empty());
}

TEST(AreaBook, WithdrawnHereItDoesNotComeBackFromTheLog) {
  AreaBook book;
  const TeamAreas team{{{kMates, kStairs}}, {}, {}};
  EXPECT_TRUE(book.note(team));
  EXPECT_TRUE(book.withdraw("2.77.3").has_value());
  EXPECT_FALSE(book.note(team));
  EXPECT_TRUE(book.areas().empty());
  EXPECT_EQ(book.wishes().withdrawn, std::vector<team::EntryId>{kMates});
  EXPECT_FALSE(book.note({{}, {kMates}, {}}));
  EXPECT_TRUE(book.wishes().withdrawn.empty()) << "the log has it";
}

TEST(AreaBook, AMateWithdrawsOneOfThisRobots) {
  AreaBook book;
  EXPECT_TRUE(book.draw(kStairs).has_value());
  EXPECT_TRUE(book.draw(kGlass).has_value());
  EXPECT_TRUE(book.note({{}, {}, {1}}));
  ASSERT_EQ(book.areas().size(), 1U);
  EXPECT_EQ(book.areas().front().number, 2U);
}

TEST(AreaBook, AFileGivesAllOfItBack) {
  AreaBook book;
  EXPECT_TRUE(book.draw(kStairs).has_value());
  EXPECT_TRUE(book.draw(kGlass).has_value());
  EXPECT_TRUE(book.withdraw("2").has_value());
  EXPECT_TRUE(book.note({{{kMates, kGlass}, {{3, 1, 1}, kGlass}}, {}, {}}));
  EXPECT_TRUE(book.withdraw("3.1.1").has_value());
  auto again = AreaBook::parse(book.text());
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(again->text(), book.text());
  EXPECT_EQ(again->json(), book.json());
  EXPECT_EQ(again->draw(kGlass).value_or(""), "3");
}

TEST(AreaBook, AFileThatIsNotWholeIsRefused) {
  AreaBook book;
  EXPECT_TRUE(book.draw(kStairs).has_value());
  const std::string text = book.text();
  for (std::size_t end = 0; end + 2 < text.size(); ++end)
    EXPECT_FALSE(AreaBook::parse(text.substr(0, end)).has_value()) << end;
  for (
      const char* bad :
      {R"({"version": 2, "last": 0, "areas": [], "withdrawn": []})",
       R"({"version": 1, "last": 1, "areas": [{"number": 1, "corners_m": [[0, 0], [1, 0]]}], "withdrawn": []})",
       R"({"version": 1, "last": 1, "areas": [{"corners_m": [[0, 0], [1, 0], [1, 1]]}], "withdrawn": []})",
       R"({"version": 1, "last": 1, "areas": [{"entry": [70000, 1, 1], "corners_m": [[0, 0], [1, 0], [1, 1]]}],
            "withdrawn": []})",
       R"({"version": 1, "last": 1, "areas": [], "withdrawn": [[1, 2]]})"})
    EXPECT_FALSE(AreaBook::parse(bad).has_value()) << bad;
}

}  // namespace
}  // namespace topo::daemon

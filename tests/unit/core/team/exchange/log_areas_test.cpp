// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/log_areas.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

using testing::Robot;
using testing::talk;

const types::Polygon kStairs{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}};
const types::Polygon kGlass{{5.0, 5.0}, {6.0, 5.0}, {6.0, 6.0}};

TEST(LogAreas, HoldUntilSomebodyWithdrawsThem) {
  std::vector<LogEntry> log{{{1, 0, 9}, KeepOut{kStairs}},
                            {{1, 1, 9}, Visited{{1.0, 1.0}, false}},
                            {{2, 0, 8}, Withdrawn{{1, 0, 9}}},
                            {{2, 1, 8}, KeepOut{kGlass}}};
  do {
    const LogAreas found = areas_of(log);
    ASSERT_EQ(found.areas.size(), 1U);
    EXPECT_EQ(found.areas.front().id, (EntryId{2, 1, 8}));
    EXPECT_EQ(found.areas.front().corners_map, kGlass);
    EXPECT_EQ(found.withdrawn, (std::set<EntryId>{{1, 0, 9}}));
  } while (std::next_permutation(log.begin(), log.end(),
                                 [](const LogEntry& a, const LogEntry& b) { return a.id < b.id; }));
}

TEST(LogAreas, AreWhereTheirRobotSaidLast) {
  const types::Polygon first{{0.1, 0.0}, {2.1, 0.0}, {2.1, 1.0}}, last{{0.2, 0.0}, {2.2, 0.0}, {2.2, 1.0}};
  std::vector<LogEntry> log{{{1, 0, 9}, KeepOut{kStairs}},
                            {{1, 3, 9}, AreaMoved{{1, 0, 9}, first}},
                            {{1, 4, 9}, AreaMoved{{1, 0, 9}, last}},
                            {{2, 7, 8}, AreaMoved{{1, 0, 9}, kGlass}},   // a mate's word
                            {{1, 8, 10}, AreaMoved{{1, 0, 9}, kGlass}},  // of another map
                            {{1, 6, 9}, AreaMoved{{1, 2, 9}, kGlass}}};  // of no area
  const auto by_id = [](const LogEntry& a, const LogEntry& b) { return a.id < b.id; };
  std::ranges::sort(log, by_id);
  do {
    const LogAreas found = areas_of(log);
    ASSERT_EQ(found.areas.size(), 1U);
    EXPECT_EQ(found.areas.front().id, (EntryId{1, 0, 9}));
    EXPECT_EQ(found.areas.front().corners_map, last);
  } while (std::next_permutation(log.begin(), log.end(), by_id));
}

TEST(LogAreas, AMoveHasAsManyCornersAsTheArea) {
  const LogAreas found = areas_of(
      {{{1, 0, 9}, KeepOut{kStairs}}, {{1, 1, 9}, AreaMoved{{1, 0, 9}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}});
  ASSERT_EQ(found.areas.size(), 1U);
  EXPECT_EQ(found.areas.front().corners_map, kStairs);
}

TEST(LogAreas, AnotherRunOfTheirRobotSaysThemAnew) {
  const std::vector<LogEntry> log{
      {{1, 0, 9}, KeepOut{kStairs}}, {{1, 0, 10}, KeepOut{kStairs}}, {{1, 1, 10}, Withdrawn{{1, 0, 9}}}};
  const LogAreas found = areas_of(log);
  EXPECT_EQ(found.areas.size(), 2U);
  EXPECT_TRUE(found.withdrawn.empty());
  EXPECT_EQ(found.said_anew, (std::map<EntryId, std::set<slam::Origin>>{{{1, 0, 9}, {{1, 10}}}}));
}

TEST(LogAreas, HaveTheKindOfTheirEntry) {
  const LogAreas found = areas_of({{{1, 0, 9}, HereFirst{kStairs}}, {{1, 1, 9}, KeepOut{kStairs}}});
  ASSERT_EQ(found.areas.size(), 2U);
  EXPECT_EQ(found.areas[0].kind, types::AreaKind::kHereFirst);
  EXPECT_EQ(found.areas[1].kind, types::AreaKind::kKeepOut);
  EXPECT_TRUE(areas_of({{{1, 0, 9}, HereFirst{kStairs}}, {{2, 0, 8}, Withdrawn{{1, 0, 9}}}}).areas.empty());
}

TEST(LogAreas, ReachMatesAndAreWithdrawnByThem) {
  Robot a(1), b(2);
  const auto id = a.exchange.add_entry(KeepOut{kStairs});
  ASSERT_TRUE(id.has_value());
  talk(a, b, 0.0, 5.0);
  const LogAreas at_b = areas_of(log_of(b.exchange.items()));
  ASSERT_EQ(at_b.areas.size(), 1U);
  EXPECT_EQ(at_b.areas.front().corners_map, kStairs);
  ASSERT_TRUE(b.exchange.add_entry(Withdrawn{*id}).has_value());
  talk(a, b, 5.0, 10.0);
  EXPECT_TRUE(areas_of(log_of(a.exchange.items())).areas.empty());
}

}  // namespace
}  // namespace topo::team

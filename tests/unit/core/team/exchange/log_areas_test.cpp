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

// An area moves by a new entry and the withdrawal of the old one: whichever comes first, one is in force.
TEST(LogAreas, AMovedOneIsNeverMissing) {
  const LogEntry before{{1, 4, 9}, KeepOut{kStairs}}, after{{1, 6, 9}, KeepOut{kGlass}},
      other{{1, 5, 9}, Visited{{1.0, 1.0}, false}}, withdrawal{{1, 7, 9}, Withdrawn{{1, 4, 9}}};
  const auto in_force = [](const std::vector<LogEntry>& log) {
    std::vector<std::uint32_t> numbers;
    for (const TeamArea& area : areas_of(log).areas) numbers.push_back(area.id.sequence);
    return numbers;
  };
  EXPECT_EQ(in_force({before, withdrawal}), std::vector<std::uint32_t>{4});
  EXPECT_EQ(in_force({before, other, withdrawal}), std::vector<std::uint32_t>{4});
  EXPECT_EQ(in_force({before, after, withdrawal}), (std::vector<std::uint32_t>{4, 6}));
  EXPECT_EQ(in_force({before, after, other}), (std::vector<std::uint32_t>{4, 6}));
  EXPECT_EQ(in_force({before, after, other, withdrawal}), std::vector<std::uint32_t>{6});
}

TEST(LogAreas, OneThatARestartedRobotSaysAnewIsNeverMissing) {
  const LogEntry before{{1, 4, 9}, KeepOut{kStairs}}, anew{{1, 0, 10}, KeepOut{kStairs}},
      withdrawal{{1, 1, 10}, Withdrawn{{1, 4, 9}}};
  EXPECT_EQ(areas_of({before, withdrawal}).areas.size(), 1U);
  const auto areas = areas_of({before, anew, withdrawal}).areas;
  ASSERT_EQ(areas.size(), 1U);
  EXPECT_EQ(areas.front().id, anew.id);
}

// Numbers from a wire: a robot that claims to have said four billion things in between costs one look.
TEST(LogAreas, AWithdrawalFarAheadOfWhatIsThereDoesNotCount) {
  const LogAreas found =
      areas_of({{{1, 0, 9}, KeepOut{kStairs}}, {{1, UINT32_MAX, 9}, Withdrawn{{1, 0, 9}}}});
  EXPECT_EQ(found.areas.size(), 1U);
  EXPECT_TRUE(found.withdrawn.empty());
  // Nor does one that comes before its area say anything of it that could be waited for.
  EXPECT_TRUE(areas_of({{{1, 5, 9}, KeepOut{kStairs}}, {{1, 2, 9}, Withdrawn{{1, 5, 9}}}}).areas.empty());
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

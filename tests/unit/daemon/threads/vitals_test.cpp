// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/vitals.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "daemon/threads/fixed_text.hpp"

namespace topo::daemon {
namespace {

using std::chrono::milliseconds;

TEST(Period, PunctualThreadMissesNothing) {
  const types::Stamp start = types::stamp_from_seconds(5.0);
  Period period(start, milliseconds(50));
  EXPECT_EQ(period.advance(start + milliseconds(3)), 0U);
  EXPECT_EQ(period.next(), start + milliseconds(50));
}

TEST(Period, LateThreadPassesWholePeriodsOver) {
  const types::Stamp start = types::stamp_from_seconds(5.0);
  Period period(start, milliseconds(50));
  EXPECT_EQ(period.advance(start + milliseconds(120)), 2U);
  EXPECT_EQ(period.next(), start + milliseconds(150));
  EXPECT_EQ(period.advance(start + milliseconds(200)),
            1U);  // 200 is over: at a deadline it is due, not early
  EXPECT_EQ(period.next(), start + milliseconds(250));
}

TEST(Period, TheGridNeverMoves) {
  EXPECT_TRUE(rc::check("however late", [] {
    const types::Stamp start = types::stamp_from_seconds(1.0);
    const types::Duration step = milliseconds(50);
    Period period(start, step);
    types::Stamp now = start;
    std::uint64_t deadlines = 0;
    for (int i = *rc::gen::inRange(1, 50); i > 0; --i) {
      now = std::max(now, period.next()) + std::chrono::microseconds(*rc::gen::inRange(0, 500000));
      deadlines += 1 + period.advance(now);
      RC_ASSERT(period.next() > now);
      RC_ASSERT(period.next() - now <= step);
      RC_ASSERT((period.next() - start) % step == types::Duration::zero());
    }
    RC_ASSERT(period.next() ==
              start + static_cast<std::int64_t>(deadlines) * step);  // every one ran or was counted
  }));
}

TEST(FixedText, CutsWhatIsTooLong) {
  FixedText<4> text;
  EXPECT_EQ(text.view(), "");
  text = "abcdef";
  EXPECT_EQ(text.view(), "abcd");
  text = "x";
  EXPECT_EQ(text.str(), "x");
}

TEST(Rarely, TellsAtOnceThenOnceAMinuteAndAtOnceWhenItBeginsAnew) {
  const types::Stamp begin{std::chrono::seconds(5)};
  Rarely rarely;
  EXPECT_TRUE(rarely.due(begin));
  EXPECT_FALSE(rarely.due(begin + std::chrono::seconds(59)));
  EXPECT_TRUE(rarely.due(begin + std::chrono::seconds(60)));
  EXPECT_FALSE(rarely.due(begin + std::chrono::seconds(61)));
  rarely.over();
  EXPECT_TRUE(rarely.due(begin + std::chrono::seconds(62)));
}

}  // namespace
}  // namespace topo::daemon

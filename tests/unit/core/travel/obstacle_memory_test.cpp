// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/obstacle_memory.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace topo::travel {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;
using types::Vector2;

const types::Stamp kStart = types::stamp_from_seconds(1000.0);
const Vector2 kPlace{2.0, 3.0};

TEST(ObstacleMemory, AnEchoCountsWhenItIsHeardThreeTimes) {
  ObstacleMemory memory;
  memory.note_echo(kPlace, kStart);
  memory.note_echo(kPlace + Vector2(0.1, 0.0), kStart);
  EXPECT_TRUE(memory.echoed().empty()) << "two may be a reflection";
  memory.note_echo(kPlace + Vector2(0.0, 0.1), kStart);
  ASSERT_EQ(memory.echoed().size(), 1U);
  EXPECT_EQ(memory.echoed().front(), kPlace);
}

TEST(ObstacleMemory, EchoesApartAreDifferentOnes) {
  ObstacleMemory memory;
  for (int i = 0; i < 3; ++i) memory.note_echo(kPlace + Vector2(0.2 * i, 0.0), kStart);
  EXPECT_TRUE(memory.echoed().empty());
}

TEST(ObstacleMemory, ATouchCountsAtOnce) {
  ObstacleMemory memory;
  memory.note_touch(kPlace, kStart);
  EXPECT_EQ(memory.echoed().size(), 1U);
}

TEST(ObstacleMemory, EverythingExpiresInItsTime) {
  ObstacleMemory memory;
  memory.note_touch(kPlace, kStart);
  memory.block(kPlace, kStart);
  memory.expire(kStart + minutes(5));
  EXPECT_EQ(memory.echoed().size(), 1U);
  EXPECT_TRUE(memory.stuck_on().empty());
  memory.expire(kStart + minutes(10));
  EXPECT_TRUE(memory.echoed().empty());
}

TEST(ObstacleMemory, APlaceWhereTheRobotGotStuckIsADisc) {
  ObstacleMemory memory;
  memory.block(kPlace, kStart);
  ASSERT_EQ(memory.stuck_on().size(), 5U);
  for (const Vector2& p : memory.stuck_on()) EXPECT_LE((p - kPlace).norm(), 0.25 + 1e-9);
}

TEST(ObstacleMemory, AClosedPassageStaysUntilItIsOpened) {
  ObstacleMemory memory;
  memory.close_passage(kPlace);
  memory.expire(kStart + minutes(600));
  EXPECT_FALSE(memory.forget(kStart)) << "neither an echo nor a place where it got stuck";
  EXPECT_EQ(memory.stuck_on().size(), 1U);
  memory.open_passages();
  EXPECT_TRUE(memory.stuck_on().empty());
}

TEST(ObstacleMemory, IsForgottenOnceAMinute) {
  ObstacleMemory memory;
  EXPECT_FALSE(memory.forget(kStart)) << "there is nothing";
  memory.block(kPlace, kStart);
  EXPECT_TRUE(memory.forget(kStart));
  EXPECT_TRUE(memory.stuck_on().empty());
  memory.note_touch(kPlace, kStart + seconds(30));
  EXPECT_FALSE(memory.forget(kStart + seconds(59)));
  EXPECT_TRUE(memory.forget(kStart + seconds(60)));
}

TEST(ObstacleMemory, KeepsSoManyEchoesAndNoMore) {
  ObstacleMemoryParams params;
  params.echoes_max = 2;
  ObstacleMemory memory(params);
  for (int i = 0; i < 5; ++i) memory.note_touch(kPlace + Vector2(1.0 * i, 0.0), kStart);
  EXPECT_EQ(memory.echoed().size(), 2U);
}

TEST(ObstacleMemory, ATouchIsNotedHoweverManyEchoesThereAre) {
  ObstacleMemoryParams params;
  params.echoes_max = 3;
  ObstacleMemory memory(params);
  for (int i = 0; i < 9; ++i) memory.note_echo(kPlace + Vector2(1.0 * i, 0.0), kStart + seconds(i));
  memory.note_touch(kPlace - Vector2(1.0, 0.0), kStart + seconds(10));
  for (int i = 0; i < 9; ++i) memory.note_echo(kPlace - Vector2(1.0 * i, 5.0), kStart + seconds(11 + i));
  ASSERT_EQ(memory.echoed().size(), 1U);
  EXPECT_EQ(memory.echoed().front(), kPlace - Vector2(1.0, 0.0));
}

/// Places far apart, so that each is one of its own: what the memory should hold, by place.
struct RememberedPlace {
  int times = 0;
  types::Stamp until{};
};

TEST(ObstacleMemory, HoldsWhatWasNotedOftenEnoughAndIsNotOver) {
  EXPECT_TRUE(rc::check([] {
    ObstacleMemory memory;
    std::array<RememberedPlace, 5> expected;
    types::Stamp now = kStart, forgotten{};
    for (int steps = *rc::gen::inRange(0, 60); steps > 0; --steps) {
      now += seconds(*rc::gen::inRange(0, 120));
      const auto which = *rc::gen::inRange<std::size_t>(0, expected.size());
      const Vector2 p = kPlace + Vector2(1.0 * static_cast<double>(which), 0.01 * *rc::gen::inRange(0, 10));
      const int action = *rc::gen::inRange(0, 8);
      if (action < 6) {
        action == 0 ? memory.note_touch(p, now) : memory.note_echo(p, now);
        expected[which].times += action == 0 ? 3 : 1;
        expected[which].until = now + minutes(10);
      } else if (action == 6) {
        memory.expire(now);
        for (RememberedPlace& place : expected)
          if (place.until <= now) place = {};
      } else {
        const bool is_empty =
            std::all_of(expected.begin(), expected.end(), [](const auto& place) { return place.times == 0; });
        const bool forgets = !is_empty && now - forgotten >= seconds(60);
        RC_ASSERT(memory.forget(now) == forgets);
        if (forgets) {
          expected = {};
          forgotten = now;
        }
      }
    }
    const auto often =
        std::count_if(expected.begin(), expected.end(), [](const auto& p) { return p.times >= 3; });
    RC_ASSERT(memory.echoed().size() == static_cast<std::size_t>(often));
    for (const Vector2& p : memory.echoed()) {
      const auto which = static_cast<std::size_t>(std::lround(p.x() - kPlace.x()));
      RC_ASSERT(expected[which].times >= 3);
    }
  }));
}

TEST(ObstacleMemory, AnEchoHeardAgainLastsFromThenOn) {
  ObstacleMemory memory;
  memory.note_touch(kPlace, kStart);
  memory.note_echo(kPlace, kStart + minutes(9));
  memory.expire(kStart + minutes(18));
  EXPECT_EQ(memory.echoed().size(), 1U);
  memory.expire(kStart + minutes(19));
  EXPECT_TRUE(memory.echoed().empty());
}

}  // namespace
}  // namespace topo::travel

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/deferred_goals.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

namespace topo::exploration {
namespace {

using types::Vector2;

types::Stamp second(int t_s) { return types::stamp_from_seconds(9000.0 + t_s); }
Vector2 anywhere() { return {0.3 * *rc::gen::inRange(0, 12), 0.3 * *rc::gen::inRange(0, 4)}; }

/// After anything that may happen in a minute.
DeferredGoals any_deferred() {
  DeferredGoals deferred;
  for (int k = *rc::gen::inRange(0, 12); k > 0; --k) {
    const types::Stamp until = second(*rc::gen::inRange(0, 120));
    switch (*rc::gen::inRange(0, 5)) {
      case 0:
        deferred.give_up(anywhere(), until, "stuck");
        break;
      case 1:
        deferred.visit(anywhere(), until);
        break;
      case 2:
        deferred.visit(anywhere(), std::nullopt);
        break;
      case 3:
        deferred.vanish(anywhere(), until);
        break;
      default:
        deferred.call_back(second(*rc::gen::inRange(0, 120)));
    }
  }
  return deferred;
}

TEST(DeferredGoals, areHeldWithinEightyCentimetresOfThoseThatAreTold) {
  EXPECT_TRUE(rc::check([] {
    const DeferredGoals deferred = any_deferred();
    const types::Stamp now = second(*rc::gen::inRange(0, 150));
    const std::vector<DeferredGoal> held = deferred.held(now);
    for (int k = 0; k < 20; ++k) {
      const Vector2 p = anywhere() + Vector2(0.01, 0.02);
      const bool is_near = std::ranges::any_of(
          held, [&](const DeferredGoal& g) { return (g.p_map - p).norm() <= DeferralParams{}.same_m; });
      RC_ASSERT(deferred.hold(p, now) == is_near);
    }
    std::vector<Vector2> visited;
    for (const DeferredGoal& g : held)
      if (g.visited) visited.push_back(g.p_map);
    RC_ASSERT(deferred.visited(now) == visited);
  }));
}

TEST(DeferredGoals, areThoseThatVanishAgainAndNotForGood) {
  const Vector2 p(3.0, 1.0);
  DeferredGoals deferred;
  deferred.vanish(p, second(60));
  EXPECT_FALSE(deferred.hold(p, second(0))) << "seen from afar";
  deferred.vanish(p + Vector2(0.3, 0.0), second(61));
  EXPECT_TRUE(deferred.hold(p, second(60)));
  EXPECT_FALSE(deferred.hold(p, second(61)));
  for (int k = 0; k < 9; ++k) deferred.vanish(p, second(100 + 100 * k));
  EXPECT_FALSE(deferred.hold(p, second(900)));
  deferred.give_up(p, second(1000), "stuck");
  EXPECT_FALSE(deferred.hold(p, second(1000))) << "given up once only";
  deferred.vanish(p, second(1100));
  EXPECT_TRUE(deferred.hold(p, second(1099)));
  EXPECT_TRUE(deferred.call_back(second(1050)));
  EXPECT_FALSE(deferred.hold(p, second(1050)));
}

TEST(DeferredGoals, comeBackAsTimeGoesByAndNeverGoAway) {
  EXPECT_TRUE(rc::check([] {
    const DeferredGoals deferred = any_deferred();
    const int t_s = *rc::gen::inRange(0, 150);
    const auto now = deferred.held(second(t_s)),
               later = deferred.held(second(t_s + *rc::gen::inRange(0, 60)));
    for (const DeferredGoal& g : later)
      RC_ASSERT(std::ranges::count(now, g.p_map, &DeferredGoal::p_map) == 1);
    const auto at_last = deferred.held(second(1000));
    RC_ASSERT(std::ranges::all_of(at_last, &DeferredGoal::is_for_good));
  }));
}

TEST(DeferredGoals, comeBackAsOftenAsTheParameterSays) {
  EXPECT_TRUE(rc::check([] {
    DeferralParams params;
    params.times_max = *rc::gen::inRange(1, 5);
    DeferredGoals deferred(params);
    for (int times = 1; times <= 5; ++times) {
      deferred.give_up({1.0, 1.0}, second(10 * times), "stuck");
      RC_ASSERT(deferred.hold({1.0, 1.0}, second(1000)) == (times >= params.times_max));
    }
  }));
}

TEST(DeferredGoals, calledBackAreOnlyThoseThatMayCome) {
  EXPECT_TRUE(rc::check([] {
    DeferredGoals deferred = any_deferred();
    const types::Stamp now = second(*rc::gen::inRange(0, 150));
    const auto before = deferred.held(now);
    const bool any = deferred.call_back(now);
    RC_ASSERT(any == !std::ranges::all_of(before, &DeferredGoal::is_for_good));
    for (const DeferredGoal& g : deferred.held(now)) RC_ASSERT(g.is_for_good());
    RC_ASSERT(static_cast<std::ptrdiff_t>(deferred.held(now).size()) ==
              std::ranges::count_if(before, &DeferredGoal::is_for_good));
    RC_ASSERT(!deferred.call_back(now));
  }));
}

TEST(DeferredGoals, nearTheFirstOfThemAreItAndKeepItsPlace) {
  DeferredGoals deferred;
  deferred.give_up({1.0, 1.0}, second(60), "stuck");
  deferred.give_up({1.8, 1.0}, second(90), "stuck again");
  ASSERT_EQ(deferred.held(second(0)).size(), 1U);
  EXPECT_EQ(deferred.held(second(0)).front().p_map, Vector2(1.0, 1.0));
  EXPECT_EQ(deferred.held(second(0)).front().times, 2);
  deferred.give_up({1.81, 1.0}, second(60), "stuck");
  EXPECT_EQ(deferred.held(second(0)).size(), 2U);
  deferred.clear();
  EXPECT_TRUE(deferred.held(second(0)).empty());
}

}  // namespace
}  // namespace topo::exploration

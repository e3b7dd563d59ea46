// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/budget.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

using testing::at;

TEST(ByteBudget, SavesUpToItsBoundAndNoFurther) {
  ByteBudget budget;
  budget.refill(1'000.0, 500.0, at(0.0));
  EXPECT_EQ(budget.bytes(), 0.0) << "the first call begins";
  budget.refill(1'000.0, 500.0, at(0.2));
  EXPECT_NEAR(budget.bytes(), 200.0, 1e-6);
  budget.refill(1'000.0, 500.0, at(3'600.0));
  EXPECT_EQ(budget.bytes(), 500.0) << "an hour apart is no burst";
}

TEST(ByteBudget, WhatWasOverdrawnIsSavedAfterwards) {
  ByteBudget budget;
  budget.refill(1'000.0, 500.0, at(0.0));
  budget.spend(300.0);
  EXPECT_FALSE(budget.allows(0.0));
  budget.refill(1'000.0, 500.0, at(0.3));
  EXPECT_TRUE(budget.allows(0.0));
  EXPECT_FALSE(budget.allows(1.0));
}

TEST(ByteBudget, TimeThatGoesBackGivesNothing) {
  ByteBudget budget;
  budget.refill(1'000.0, 500.0, at(1.0));
  budget.refill(1'000.0, 500.0, at(0.0));
  budget.refill(1'000.0, 500.0, at(1.0));
  EXPECT_EQ(budget.bytes(), 0.0);
}

TEST(Periodic, VariesWithinItsShareAndAlikeForOneSeed) {
  Periodic a(7), b(7), c(8);
  bool differs = false;
  for (int i = 0; i < 50; ++i) {
    const types::Stamp now = at(10.0 * i);
    for (Periodic* each : {&a, &b, &c}) each->done(now, 1.0, 0.25);
    EXPECT_FALSE(a.is_due(now + types::from_seconds(0.74)));
    EXPECT_TRUE(a.is_due(now + types::from_seconds(1.26)));
    for (double s = 0.75; s < 1.25; s += 0.05) {
      const types::Stamp then = now + types::from_seconds(s);
      EXPECT_EQ(a.is_due(then), b.is_due(then));
      differs = differs || a.is_due(then) != c.is_due(then);
    }
  }
  EXPECT_TRUE(differs) << "another seed varies otherwise";
}

TEST(Periodic, IsDueAtFirstAndCanBeHastened) {
  Periodic periodic;
  EXPECT_TRUE(periodic.is_due(at(0.0)));
  periodic.done(at(0.0), 10.0, 0.0);
  EXPECT_FALSE(periodic.is_due(at(5.0)));
  periodic.hasten(at(4.0));
  EXPECT_TRUE(periodic.is_due(at(5.0)));
}

}  // namespace
}  // namespace topo::team

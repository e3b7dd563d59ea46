// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/pursuit.hpp"

#include <gtest/gtest.h>

namespace topo::exploration {
namespace {

using types::Vector2;

const types::Stamp kStart = types::stamp_from_seconds(100.0);
const Vector2 kHere{1.0, 1.0}, kFar{9.0, 1.0};
constexpr double kReached_m = 0.5;

Pursuit underway() {
  goals::Goal goal;
  goal.p_map = kFar;
  return set_out({}, goal, {Source::kEssential, 1}, kStart, kHere);
}

Settled settled_at(const Pursuit& pursuit, const Feedback& feedback, const Vector2& here, types::Stamp now) {
  return settled(pursuit, feedback, here, kFar, kReached_m, now, {});
}

TEST(Pursuit, EveryGoalHasANumberOfItsOwn) {
  const Pursuit first = underway();
  const Pursuit second = set_out(first, *first.goal, {Source::kGap, 2}, kStart, kHere);
  EXPECT_EQ(first.number, 1U);
  EXPECT_EQ(second.number, 2U);
  EXPECT_NE(first.id, second.id);
}

TEST(Pursuit, IsReachedNearItsTarget) {
  EXPECT_EQ(settled_at(underway(), {}, kFar + Vector2(0.4, 0.0), kStart), Settled::kReached);
  EXPECT_EQ(settled_at(underway(), {}, kFar + Vector2(0.6, 0.0), kStart), Settled::kUnderWay);
}

TEST(Pursuit, IsReachedAtTheEndOfControlsPath) {
  const Pursuit pursuit = underway();
  EXPECT_EQ(settled_at(pursuit, {pursuit.number, true, false}, kHere, kStart), Settled::kReached);
}

TEST(Pursuit, AReportOnAnotherNumberIsIgnored) {
  const Pursuit pursuit = underway();
  EXPECT_EQ(settled_at(pursuit, {pursuit.number + 1, true, true}, kHere, kStart), Settled::kUnderWay);
}

TEST(Pursuit, ATurnEndsWhenControlReportsItAndNotByNearness) {
  const Pursuit before = underway();
  const Pursuit turn = turning_to(1.5, before, kStart);
  EXPECT_FALSE(turn.goal || turn.has_target);
  EXPECT_EQ(settled_at(turn, {}, kFar, kStart), Settled::kUnderWay) << "where its last target was";
  EXPECT_EQ(settled_at(turn, {before.number, true, false}, kFar, kStart), Settled::kUnderWay);
  EXPECT_EQ(settled_at(turn, {turn.number, true, false}, kHere, kStart), Settled::kReached);
  EXPECT_EQ(settled_at(turn, {turn.number, false, true}, kHere, kStart), Settled::kStuck);
}

TEST(Pursuit, AnotherGoalOrNoneEndsATurn) {
  const Pursuit turn = turning_to(1.5, underway(), kStart);
  EXPECT_FALSE(without_goal(turn).turn_to_rad);
  EXPECT_FALSE(set_out(turn, {}, {Source::kGap, 2}, kStart, kHere).turn_to_rad);
}

TEST(Pursuit, StuckComesBeforeEverythingElse) {
  const Pursuit pursuit = underway();
  EXPECT_EQ(settled_at(pursuit, {pursuit.number, true, true}, kFar, kStart), Settled::kStuck);
}

TEST(Pursuit, StandingStillEndsIt) {
  EXPECT_EQ(settled_at(underway(), {}, kHere, kStart + std::chrono::seconds(25)), Settled::kUnderWay);
  EXPECT_EQ(settled_at(underway(), {}, kHere, kStart + std::chrono::seconds(26)), Settled::kNoProgress);
}

TEST(Pursuit, ProgressIsHalfAMetre) {
  const types::Stamp later = kStart + std::chrono::seconds(20);
  EXPECT_EQ(with_progress(underway(), kHere + Vector2(0.4, 0.0), later, {}).last_progress, kStart);
  EXPECT_EQ(with_progress(underway(), kHere + Vector2(0.6, 0.0), later, {}).last_progress, later);
}

TEST(Pursuit, TakesFourMinutesAtMost) {
  Pursuit pursuit = underway();
  const types::Stamp late = kStart + std::chrono::seconds(241);
  pursuit = with_progress(pursuit, kHere + Vector2(3.0, 0.0), late, {});
  EXPECT_EQ(settled_at(pursuit, {}, kHere + Vector2(3.0, 0.0), late), Settled::kTooLong);
}

}  // namespace
}  // namespace topo::exploration

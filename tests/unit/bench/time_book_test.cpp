// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/time_book.hpp"

#include <gtest/gtest.h>

namespace topo::bench {
namespace {

using motion::GateReason;
using pipeline::ControlMode;

constexpr double kPeriod_s = 0.1, kPermitted_mps = 0.7;

Moment moment(double v_mps, double omega_radps, ControlMode mode = ControlMode::kFollowing,
              GateReason reason = GateReason::kFree, bool has_way = true) {
  return {kPeriod_s, {v_mps, omega_radps}, kPermitted_mps, mode, reason, has_way};
}

double doing(const TimeBook& book, Doing what) {
  return book.spent().doing_s[static_cast<std::size_t>(what)];
}
double lost(const TimeBook& book, Loss why) { return book.spent().lost_s[static_cast<std::size_t>(why)]; }

TEST(TimeBook, tellsDrivingTurningAndStandingApart) {
  TimeBook book;
  book.add(moment(0.69, 0.1));
  book.add(moment(0.35, 0.1));
  book.add(moment(0.0, 0.8));
  book.add(moment(0.0, 0.0));
  book.add(moment(0.0, 0.0, ControlMode::kWaiting));
  for (std::size_t i = 0; i < kDoings; ++i)
    EXPECT_DOUBLE_EQ(book.spent().doing_s[i], kPeriod_s) << kDoingNames[i];
  EXPECT_NEAR(book.spent().all_s(), 0.5, 1e-12);
}

TEST(TimeBook, losesTheShareOfTheSpeedThatIsMissing) {
  TimeBook book;
  book.add(moment(0.35, 0.0, ControlMode::kFollowing, GateReason::kSlowed));
  book.add(moment(0.35, 0.0, ControlMode::kFollowing, GateReason::kSlowed));
  EXPECT_NEAR(lost(book, Loss::kSpeedingUp) + lost(book, Loss::kObstacle), kPeriod_s, 1e-12);
  EXPECT_NEAR(lost(book, Loss::kObstacle), 0.5 * kPeriod_s, 1e-12) << "the first of them speeds up";
}

TEST(TimeBook, tellsSpeedingUpFromBrakingAndCurves) {
  TimeBook book;
  for (const double v_mps : {0.03, 0.06, 0.06, 0.03}) book.add(moment(v_mps, 0.3));
  EXPECT_NEAR(lost(book, Loss::kSpeedingUp), kPeriod_s * (2.0 - 0.09 / kPermitted_mps), 1e-9);
  EXPECT_NEAR(lost(book, Loss::kCurveOrNarrow), kPeriod_s * (1.0 - 0.06 / kPermitted_mps), 1e-9);
  EXPECT_NEAR(lost(book, Loss::kBraking), kPeriod_s * (1.0 - 0.03 / kPermitted_mps), 1e-9);
}

TEST(TimeBook, namesWhyTheRobotStands) {
  TimeBook book;
  book.add(moment(0.0, 0.0, ControlMode::kStanding, GateReason::kFree, false));
  book.add(moment(0.0, 0.0, ControlMode::kFollowing, GateReason::kStaleScan));
  book.add(moment(0.0, 0.0, ControlMode::kFollowing, GateReason::kGivesWay));
  book.add(moment(0.0, 0.5, ControlMode::kRecovering));
  EXPECT_DOUBLE_EQ(lost(book, Loss::kNoGoal), kPeriod_s);
  EXPECT_DOUBLE_EQ(lost(book, Loss::kStopped), kPeriod_s);
  EXPECT_DOUBLE_EQ(lost(book, Loss::kWaiting), kPeriod_s);
  EXPECT_DOUBLE_EQ(lost(book, Loss::kRecovery), kPeriod_s);
}

TEST(TimeBook, losesNothingAtThePermittedSpeed) {
  TimeBook book;
  book.add(moment(0.7, 0.0));
  book.add(moment(0.75, 0.0));
  for (const double lost_s : book.spent().lost_s) EXPECT_DOUBLE_EQ(lost_s, 0.0);
  EXPECT_DOUBLE_EQ(doing(book, Doing::kFullSpeed), 2.0 * kPeriod_s);
}

TEST(TimeBook, addsUpOverRobots) {
  TimeBook one, two;
  one.add(moment(0.7, 0.0));
  two.add(moment(0.0, 0.5));
  TimeSpent both = one.spent();
  both += two.spent();
  EXPECT_DOUBLE_EQ(both.all_s(), 2.0 * kPeriod_s);
  EXPECT_DOUBLE_EQ(both.lost_s[static_cast<std::size_t>(Loss::kTurning)], kPeriod_s);
}

}  // namespace
}  // namespace topo::bench

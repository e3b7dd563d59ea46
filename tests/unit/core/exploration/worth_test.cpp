// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/worth.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace topo::exploration {
namespace {

/// Goals on a line through the robot, at these metres; home is where the robot's start is.
TourGoals on_a_line(const std::vector<double>& at_m, double start_m) {
  TourGoals goals(at_m.size());
  for (std::size_t i = 0; i < at_m.size(); ++i) {
    goals.from_start_m[i] = std::abs(at_m[i]);
    goals.to_home_m[i] = std::abs(at_m[i] - start_m);
    goals.worth[i] = 1.0;
    for (std::size_t j = 0; j < at_m.size(); ++j) goals.between(i, j) = std::abs(at_m[i] - at_m[j]);
  }
  return goals;
}

/// A metre a second, a square metre a second, and no time at a goal: gains and metres can be compared.
WorthParams one_to_one() {
  WorthParams params;
  params.rate_m2ps = params.speed_mps = 1.0;
  params.stop_s = 0.0;
  return params;
}

std::set<std::size_t> left_out(const std::vector<double>& at_m, double start_m,
                               const std::vector<double>& gain_m2) {
  std::set<std::size_t> out;
  const TourGoals goals = on_a_line(at_m, start_m);
  for (const LeftOut& left : not_worth_it(goals, gain_m2, std::abs(start_m), one_to_one()))
    out.insert(left.goal);
  return out;
}

using Goals = std::set<std::size_t>;

TEST(Worth, AGoalIsWorthItsDetourNotItsDistance) {
  EXPECT_EQ(left_out({30.0}, 0.0, {59.0}), Goals{0}) << "there and back is 60 m";
  EXPECT_EQ(left_out({30.0}, 0.0, {61.0}), Goals{});
  EXPECT_EQ(left_out({30.0}, 50.0, {0.1}), Goals{}) << "it lies on the way home";
}

TEST(Worth, BesideTheRobotASmallGainIsTaken) {
  EXPECT_EQ(left_out({1.0}, -20.0, {3.0}), Goals{});
  EXPECT_EQ(left_out({10.0}, -20.0, {3.0}), Goals{0});
}

TEST(Worth, TheWayIsWorthItForAllThatIsThere) {
  EXPECT_EQ(left_out({30.0, 31.0, 32.0}, 0.0, {25.0, 25.0, 25.0}), Goals{}) << "75 m2 for 64 m";
  EXPECT_EQ(left_out({30.0, 31.0, 32.0}, 0.0, {20.0, 20.0, 20.0}), (Goals{0, 1, 2})) << "60 m2 for 64 m";
}

TEST(Worth, AFarRoomDoesNotSpoilANearOne) {
  EXPECT_EQ(left_out({2.0, 40.0}, 0.0, {5.0, 30.0}), Goals{1});
  EXPECT_EQ(left_out({2.0, 40.0}, 0.0, {0.5, 90.0}), Goals{}) << "on the way to it";
}

TEST(Worth, AStretchThatIsLeftOutDoesNotTakeAGoodGoalWithIt) {
  // 1 at 2 m is worth its detour; 0 and 2, before and behind it on the tour, are not.
  EXPECT_EQ(left_out({-20.0, 2.0, 30.0}, 0.0, {1.0, 6.0, 1.0}), (Goals{0, 2}));
}

TEST(Worth, NothingLeftOutIsWorthItsDetourByItself) {
  EXPECT_TRUE(rc::check([] {
    const auto numbers = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-300, 300));
    const std::size_t count = std::min<std::size_t>(numbers.size(), 12);
    std::vector<double> at_m, gain_m2;
    for (std::size_t i = 0; i < count; ++i) {
      at_m.push_back(0.1 * numbers[i]);
      gain_m2.push_back(*rc::gen::inRange(0, 60));
    }
    for (const LeftOut& left : not_worth_it(on_a_line(at_m, 0.0), gain_m2, 0.0, one_to_one())) {
      RC_ASSERT(left.gain_m2 == gain_m2[left.goal]);
      RC_ASSERT(left.gain_m2 <= left.time_s + 1e-9);
    }
  }));
}

TEST(Worth, WhyItIsLeftOutAreItsNumbers) {
  const TourGoals goals = on_a_line({10.0}, 0.0);
  WorthParams params = one_to_one();
  params.speed_mps = 0.5;
  params.stop_s = 2.0;
  const std::vector<double> gain_m2{7.0};
  const auto out = not_worth_it(goals, gain_m2, 0.0, params);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_DOUBLE_EQ(out.front().gain_m2, 7.0);
  EXPECT_DOUBLE_EQ(out.front().time_s, 42.0);
}

TEST(Worth, AHigherRateAsksNoLess) {
  EXPECT_TRUE(rc::check("nothing at almost no rate, all at a rate beyond all", [] {
    const auto numbers = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-300, 300));
    const std::size_t count = std::min<std::size_t>(numbers.size(), 12);
    std::vector<double> at_m, gain_m2(count, 1.0);
    for (std::size_t i = 0; i < count; ++i) at_m.push_back(0.1 * numbers[i]);
    WorthParams params;
    params.stop_s = 1.0;
    const TourGoals goals = on_a_line(at_m, 0.0);
    params.rate_m2ps = 1e-6;
    RC_ASSERT(not_worth_it(goals, gain_m2, 0.0, params).empty());
    params.rate_m2ps = 1e6;
    RC_ASSERT(not_worth_it(goals, gain_m2, 0.0, params).size() == count);
  }));
}

}  // namespace
}  // namespace topo::exploration

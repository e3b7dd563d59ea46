// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/breakdown.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace topo::bench {
namespace {

using nlohmann::json;

json report(double full_s, double slower_s, const json& way99_m) {
  return {
      {"time_s",
       {{"full_speed", full_s}, {"slower", slower_s}, {"turning", 0.0}, {"standing", 0.0}, {"waiting", 0.0}}},
      {"lost_s",
       {{"turning", 0.0},
        {"speeding_up", 0.5 * slower_s},
        {"braking", 0.0},
        {"obstacle", 0.0},
        {"curve_or_narrow", 0.0},
        {"recovery", 0.0},
        {"waiting", 0.0},
        {"no_goal", 0.0},
        {"stopped", 0.0}}},
      {"way_m", {{"0.5", 10.0}, {"0.99", way99_m}}},
      {"mean_speed_mps", 0.5},
      {"last_share_of_time", 0.25},
      {"goals_left_for_another", 0.4},
      {"corridors_crossed", {{"squares", 20}, {"over_twice", 5}}}};
}

const Entrant kTopometric{"topometric", 2, "perfect"};

BrokenDown run(const std::string& world, double full_s, double slower_s, const json& way99_m) {
  BrokenDown out;
  out.world = world;
  out.entrant = kTopometric;
  if (const auto parts = breakdown_of(report(full_s, slower_s, way99_m))) out.parts = *parts;
  return out;
}

TEST(Breakdown, isReadFromAReport) {
  const auto parts = breakdown_of(report(60.0, 40.0, 120.0));
  ASSERT_TRUE(parts.has_value());
  EXPECT_DOUBLE_EQ(parts->time.all_s(), 100.0);
  EXPECT_DOUBLE_EQ(parts->time.lost_s[static_cast<std::size_t>(Loss::kSpeedingUp)], 20.0);
  EXPECT_EQ(parts->way99_m, 120.0);
  EXPECT_DOUBLE_EQ(parts->crossed_over_twice, 0.25);
}

TEST(Breakdown, isNothingOfAnOlderReport) {
  EXPECT_FALSE(breakdown_of(json{{"t99_s", 100.0}}).has_value());
  for (const char* key : {"time_s", "lost_s", "way_m", "goals_left_for_another", "corridors_crossed"}) {
    json one_less = report(60.0, 40.0, 120.0);
    one_less.erase(key);
    EXPECT_FALSE(breakdown_of(one_less).has_value()) << key;
  }
}

TEST(Breakdown, hasSharesOfAllRunsTogether) {
  const std::vector<BrokenDown> runs{run("a", 90.0, 10.0, 100.0), run("b", 100.0, 200.0, 100.0)};
  const Breakdown row = breakdown_of(kTopometric, runs, {});
  EXPECT_EQ(row.runs, 2U);
  EXPECT_DOUBLE_EQ(row.doing[static_cast<std::size_t>(Doing::kFullSpeed)], 190.0 / 400.0);
  EXPECT_DOUBLE_EQ(row.lost[static_cast<std::size_t>(Loss::kSpeedingUp)], 105.0 / 400.0);
  EXPECT_DOUBLE_EQ(row.goals_left, 0.4);
  EXPECT_EQ(row.over_bound.pairs, 0U) << "no bound is known";
}

TEST(Breakdown, comparesWaysWithTheBoundsOfTheirWorlds) {
  const std::vector<BrokenDown> runs{run("a", 90.0, 10.0, 100.0), run("b", 90.0, 10.0, 90.0),
                                     run("c", 90.0, 10.0, nullptr)};
  const Bounds bounds{{{"a", 1, 2}, {50.0, 25.0}},
                      {{"b", 1, 2}, {45.0, 30.0}},
                      {{"c", 1, 2}, {45.0, 30.0}},
                      {{"a", 1, 1}, {1.0, 1.0}}};
  const Breakdown row = breakdown_of(kTopometric, runs, bounds);
  EXPECT_EQ(row.over_bound.pairs, 2U) << "one never knew 99 %";
  EXPECT_NEAR(row.over_bound.ratio, 2.0, 1e-12);
  EXPECT_NEAR(row.over_lower.ratio, std::sqrt(12.0), 1e-12);
  const std::string text = text_of(std::span<const Breakdown>(&row, 1));
  EXPECT_NE(text.find("| 2 x topometric | 90 % | 10 % |"), std::string::npos) << text;
  EXPECT_NE(text.find("2.00 [2.00 to 2.00] (3.46), 2 runs"), std::string::npos) << text;
}

TEST(Breakdown, saysNothingWithoutRuns) {
  const Breakdown row = breakdown_of(kTopometric, {}, {});
  EXPECT_TRUE(text_of(std::span<const Breakdown>(&row, 1)).empty());
}

}  // namespace
}  // namespace topo::bench

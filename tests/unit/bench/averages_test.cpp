// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/averages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/bench/topobench/table/table_text.hpp"
#include "tests/unit/bench/table_reports.hpp"

namespace topo::bench {
namespace {

using nlohmann::json;
using Times = std::array<double, kTimes>;

TableRun run_of(const RunKey& key, const json& report) {
  const auto run = table_run_of(key, report, Time::kT95);
  EXPECT_TRUE(run.has_value()) << (run ? "" : run.error().message);
  return *run;
}

TableRun good_run(const std::string& world, const std::string& strategy, int robots, std::uint64_t seed,
                  double t_s) {
  return run_of(testing::key_of(world, strategy, robots, seed), testing::good_report(robots, t_s));
}

TEST(TableRun, hasTheTimesOfItsReport) {
  const TableRun run = good_run("office", "topometric", 2, 1, 10.0);
  EXPECT_EQ(run.times_s, (Times{10.0, 20.0, 30.0, 40.0, 50.0}));
  EXPECT_FALSE(run.failed);
  EXPECT_EQ(run.distance_m, 21.0) << "of both robots";
  EXPECT_EQ(run.overlap, 0.25);
  EXPECT_EQ(run.decision_p99_ms, 5.0);
}

TEST(TableRun, countsTheLimitForAShareThatItDidNotReach) {
  json report = testing::good_report(1, 10.0);
  report["t99_s"] = nullptr;
  const RunKey key = testing::key_of("office", "topometric", 1, 1);
  EXPECT_EQ(run_of(key, report).times_s, (Times{10.0, 20.0, 30.0, 1000.0, 50.0}));
  EXPECT_FALSE(run_of(key, report).failed) << "95 % were asked for";
  report["t95_s"] = nullptr;
  EXPECT_EQ(run_of(key, report).times_s, (Times{10.0, 20.0, 1000.0, 1000.0, 1000.0}))
      << "who comes home without having done its work has no time for it";
  EXPECT_TRUE(run_of(key, report).failed);
}

TEST(TableRun, countsTheLimitForCollisionsAndMissingRobots) {
  const RunKey key = testing::key_of("office", "topometric", 2, 1);
  const Times limits{1000.0, 1000.0, 1000.0, 1000.0, 1000.0};
  json touched = testing::good_report(2, 10.0);
  touched["collisions"] = 1;
  EXPECT_EQ(run_of(key, touched).times_s, limits);
  json lost = testing::good_report(2, 10.0);
  lost["home"][1] = false;
  EXPECT_EQ(run_of(key, lost).times_s, limits);
  EXPECT_EQ(run_of(key, lost).robots_not_home, 1);
  json late = testing::good_report(2, 10.0);
  late["t_home_s"] = nullptr;  // at its start when the time was over, and not done
  EXPECT_EQ(run_of(key, late).times_s, (Times{10.0, 20.0, 30.0, 40.0, 1000.0}));
  for (const json& report : {touched, lost, late}) EXPECT_TRUE(run_of(key, report).failed);
}

TEST(TableRun, thatCrashedFailedWithEverybody) {
  const TableRun run = crashed_run(testing::key_of("office", "min_pos", 3, 1), "killed");
  EXPECT_TRUE(run.crashed);
  EXPECT_TRUE(run.failed);
  EXPECT_EQ(run.why, "killed");
  EXPECT_EQ(run.robots_not_home, 3);
  EXPECT_EQ(run.times_s, (Times{1000.0, 1000.0, 1000.0, 1000.0, 1000.0}));
}

TEST(TableRun, namesTheKeyOfAStrangeReport) {
  const json good = testing::good_report(1, 10.0);
  for (const auto& item : good.items()) {
    for (const json& wrong : {json("soon"), json(json::array({"x"}))}) {
      json report = good;
      report[item.key()] = wrong;
      const auto run = table_run_of(testing::key_of("office", "min_pos", 1, 1), report, Time::kT95);
      ASSERT_FALSE(run.has_value()) << item.key();
      EXPECT_NE(run.error().message.find(item.key()), std::string::npos) << run.error().message;
    }
  }
}

TEST(Average, isOfTheRunsOfOneEntrant) {
  std::vector<TableRun> runs{good_run("a", "topometric", 2, 1, 10.0), good_run("a", "topometric", 2, 2, 30.0),
                             good_run("a", "topometric", 1, 1, 70.0), good_run("a", "min_pos", 2, 1, 80.0)};
  runs.push_back(crashed_run(testing::key_of("b", "topometric", 2, 1), "killed"));
  const Average average = average_of({"topometric", 2}, runs);
  EXPECT_EQ(average.runs, 3U);
  EXPECT_EQ(average.failed, 1U);
  EXPECT_DOUBLE_EQ(average.times_s[0], (10.0 + 30.0 + 1000.0) / 3.0);
  EXPECT_EQ(average.worst_s[1], 1000.0);
  EXPECT_DOUBLE_EQ(average.distance_m, 21.0) << "of those that are known";
  EXPECT_EQ(average.overlap, 0.25);
  EXPECT_DOUBLE_EQ(average.decision_p99_ms, 10.0);
  EXPECT_DOUBLE_EQ(average.decision_p99_worst_ms, 15.0);
  EXPECT_EQ(average.robots_not_home, 2);
}

TEST(Compare, pairsWorldAndSeed) {
  const std::vector<TableRun> runs{
      good_run("a", "topometric", 2, 1, 10.0), good_run("a", "min_pos", 1, 1, 20.0),
      good_run("a", "topometric", 2, 2, 10.0), good_run("a", "min_pos", 1, 2, 80.0),
      good_run("b", "topometric", 2, 1, 10.0), good_run("c", "min_pos", 1, 1, 10.0)};
  const Comparison c = compare(runs, {{"topometric", 2}, {{"min_pos", 1}}});
  EXPECT_EQ(c.ratios[0].pairs, 2U);
  EXPECT_EQ(c.ratios[0].a_less, 2U);
  EXPECT_NEAR(c.ratios[0].ratio, 0.25, 1e-12) << "the geometric mean of 1/2 and 1/8";
}

TEST(Compare, aFailureCountsAsTheLimitOnEitherSide) {
  json lost = testing::good_report(1, 10.0);
  lost["home"][0] = false;
  const std::vector<TableRun> runs{good_run("a", "topometric", 1, 1, 10.0),
                                   run_of(testing::key_of("a", "min_pos", 1, 1), lost)};
  EXPECT_NEAR(compare(runs, {{"topometric", 1}, {{"min_pos", 1}}}).ratios[0].ratio, 0.01, 1e-12);
  EXPECT_NEAR(compare(runs, {{"min_pos", 1}, {{"topometric", 1}}}).ratios[0].ratio, 100.0, 1e-9);
}

TEST(Compare, takesTheBestOfSeveralInEveryWorldByItsMean) {
  // In a, min_pos is the better one in the mean though not with seed 2; in b it is nearest_frontier.
  const std::vector<TableRun> runs{
      good_run("a", "topometric", 1, 1, 10.0),       good_run("a", "topometric", 1, 2, 10.0),
      good_run("a", "min_pos", 1, 1, 20.0),          good_run("a", "min_pos", 1, 2, 40.0),
      good_run("a", "nearest_frontier", 1, 1, 80.0), good_run("a", "nearest_frontier", 1, 2, 10.0),
      good_run("b", "topometric", 1, 1, 10.0),       good_run("b", "min_pos", 1, 1, 90.0),
      good_run("b", "nearest_frontier", 1, 1, 10.0), good_run("c", "topometric", 1, 1, 1.0),
      good_run("c", "min_pos", 1, 1, 10.0)};
  const Comparison c = compare(runs, {{"topometric", 1}, {{"min_pos", 1}, {"nearest_frontier", 1}}});
  EXPECT_EQ(c.ratios[0].pairs, 3U) << "in c one of them did not run";
  EXPECT_NEAR(c.ratios[0].ratio, std::cbrt(1.0 / 2.0 * 1.0 / 4.0), 1e-12);
}

TEST(TableRun, saysWhyItFailed) {
  const RunKey key = testing::key_of("office", "topometric", 2, 1);
  EXPECT_EQ(run_of(key, testing::good_report(2, 10.0)).why, "");
  json report = testing::good_report(2, 10.0);
  report["t_home_s"] = nullptr;
  EXPECT_EQ(run_of(key, report).why, "not done when the time was over");
  report["t95_s"] = nullptr;
  EXPECT_EQ(run_of(key, report).why, "did not reach t95");
  report["home"][1] = false;
  EXPECT_EQ(run_of(key, report).why, "1 robots not home");
  report["collisions"] = 2;
  EXPECT_EQ(run_of(key, report).why, "2 collisions");
}

TEST(TableRun, mayHaveDecidedNothing) {
  json report = testing::good_report(1, 10.0);
  report["decision_ms"] = nullptr;
  EXPECT_EQ(run_of(testing::key_of("office", "min_pos", 1, 1), report).decision_p99_ms, 0.0);
}

TEST(TableText, namesWhatFailedSoThatItCanBeRunAgain) {
  Table table;
  table.failures.push_back(crashed_run(testing::key_of("office", "min_pos", 3, 7), "killed"));
  EXPECT_NE(text_of(table).find("- office, 3 x min_pos, `--seed 7 --start 1.25,2.5,0.125`: killed"),
            std::string::npos)
      << text_of(table);
  const json failure = json_of(table)["failures"][0];
  EXPECT_EQ(failure["seed"], 7);
  EXPECT_EQ(failure["why"], "killed");
}

TEST(TableText, doesNotDependOnTheOrderOfTheRuns) {
  std::mt19937 random(3);
  std::vector<TableRun> runs;
  for (const char* world : {"a", "b", "c"}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      for (const char* strategy : {"topometric", "min_pos"})
        runs.push_back(good_run(world, strategy, 2, seed, 1.0 + static_cast<double>(random() % 1000) / 7.0));
    }
  }
  const Entrant a{"topometric", 2}, b{"min_pos", 2};
  const auto table = [&] {
    Table out;
    out.share = "t95";
    out.averages = {average_of(a, runs), average_of(b, runs)};
    out.comparisons = {compare(runs, {a, {b}})};
    return out;
  };
  const std::string text = text_of(table()), object = json_of(table()).dump();
  EXPECT_NE(text.find("| 2 x topometric | 15 | 15 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| 2 x topometric | 2 x min_pos | 15 | 3 |"), std::string::npos) << text;
  for (int i = 0; i < 20; ++i) {
    std::shuffle(runs.begin(), runs.end(), random);
    ASSERT_EQ(text_of(table()), text);
    ASSERT_EQ(json_of(table()).dump(), object) << "to the last bit";
  }
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/mean_coverage.hpp"

#include <gtest/gtest.h>

namespace topo::bench {
namespace {

using Curve = std::vector<std::pair<double, double>>;
const Entrant kA{"topometric", 1}, kB{"min_pos", 1};

TableRun run_of(const Entrant& entrant, const std::string& world, std::uint64_t seed, Curve coverage) {
  TableRun run;
  run.world = world;
  run.seed = seed;
  run.entrant = entrant;
  run.coverage = std::move(coverage);
  return run;
}

TEST(ShareAt, isWhatWasNotedLast) {
  const Curve curve{{5.0, 0.2}, {10.0, 0.6}};
  EXPECT_EQ(share_at(curve, 4.9), 0.0);
  EXPECT_EQ(share_at(curve, 5.0), 0.2);
  EXPECT_EQ(share_at(curve, 9.9), 0.2);
  EXPECT_EQ(share_at(curve, 1000.0), 0.6) << "what is known stays known";
  EXPECT_EQ(share_at({}, 1.0), 0.0);
}

TEST(MeanCoverage, isOverTheConditionsThatAllHave) {
  const std::vector<TableRun> runs{
      run_of(kA, "a", 1, {{5.0, 0.5}, {10.0, 1.0}}), run_of(kB, "a", 1, {{5.0, 0.1}, {10.0, 0.2}}),
      run_of(kA, "b", 1, {{5.0, 0.1}, {10.0, 0.2}}),
      run_of(kB, "b", 1, {{5.0, 0.3}, {10.0, 0.4}, {15.0, 0.8}}), run_of(kA, "b", 2, {{5.0, 1.0}})};
  const auto curves = mean_coverage(runs, std::vector{kA, kB}, "");
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].runs, 2U) << "seed 2 has but one of them";
  ASSERT_EQ(curves[0].coverage.size(), 4U) << "0, 5, 10 and 15 s: as long as the longest";
  EXPECT_EQ(curves[0].coverage[0], std::pair(0.0, 0.0));
  EXPECT_NEAR(curves[0].coverage[1].second, 0.3, 1e-12);
  EXPECT_NEAR(curves[0].coverage[3].second, 0.6, 1e-12);
  EXPECT_NEAR(curves[1].coverage[3].second, 0.5, 1e-12);
}

TEST(MeanCoverage, canBeOfOneWorld) {
  const std::vector<TableRun> runs{run_of(kA, "a", 1, {{5.0, 0.5}}), run_of(kA, "b", 1, {{5.0, 0.1}})};
  const auto curves = mean_coverage(runs, std::vector{kA}, "b");
  ASSERT_EQ(curves.front().runs, 1U);
  EXPECT_EQ(curves.front().coverage.back(), std::pair(5.0, 0.1));
}

TEST(MeanCoverage, hasARunThatCrashedAsNothing) {
  const std::vector<TableRun> runs{run_of(kA, "a", 1, {{5.0, 0.8}}), run_of(kA, "a", 2, {})};
  EXPECT_NEAR(mean_coverage(runs, std::vector{kA}, "a").front().coverage.back().second, 0.4, 1e-12);
}

TEST(MeanCoverage, ofNoRunsIsAPictureWithoutCurves) {
  const auto curves = mean_coverage({}, std::vector{kA, kB}, "");
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_TRUE(curves[0].coverage.empty());
  EXPECT_GT(picture_of(curves).width(), 0);
}

TEST(CoveragePicture, showsEveryCurveInItsColour) {
  const std::vector<TableRun> runs{run_of(kA, "a", 1, {{50.0, 0.9}, {100.0, 0.9}}),
                                   run_of(kB, "a", 1, {{50.0, 0.3}, {100.0, 0.3}})};
  const sim::Picture picture = picture_of(mean_coverage(runs, std::vector{kA, kB}, "a"));
  int of_a = 0, of_b = 0;
  for (double x = 0.5; x < picture.width(); ++x) {
    for (double y = 0.5; y < picture.height(); ++y) {
      const sim::Colour c = picture.at({x, y});
      of_a += c.red == 213 && c.green == 94 ? 1 : 0;
      of_b += c.red == 0 && c.green == 114 ? 1 : 0;
    }
  }
  EXPECT_GT(of_a, 300);
  EXPECT_GT(of_b, 300);
}

}  // namespace
}  // namespace topo::bench

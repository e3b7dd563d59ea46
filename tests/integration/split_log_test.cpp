// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The halves of a real log play two robots: what they join is as good as what one robot makes of the whole.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/bench/topobench/log_run.hpp"
#include "tests/bench/topobench/slam/split_run.hpp"

namespace topo::bench {
namespace {

constexpr double kAsGood = 1.10;  ///< times the error of the whole log

class SplitLog : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("TOPOMETRIC_DATA");
    if (folder == nullptr || *folder == '\0')
      GTEST_SKIP() << "skipped: TOPOMETRIC_DATA does not name the folder of the real logs";
    const std::string data = folder, name = GetParam();
    auto log = read_log(data + "/slam_logs/" + name + ".clf.bz2");
    ASSERT_TRUE(log) << log.error().message;
    log_ = std::move(*log);
    auto relations = read_relations(data + "/relations/" + name + ".relations.bz2");
    ASSERT_TRUE(relations) << relations.error().message;
    relations_ = std::move(*relations);
  }

  void expect_as_good(const SplitRun& split, const MappingRun& whole) const {
    const auto joined = evaluate_relations(relations_, split.trajectory);
    const auto alone = evaluate_relations(relations_, whole.trajectory);
    EXPECT_EQ(joined.skipped, 0) << "nothing of either robot is left out";
    EXPECT_EQ(joined.used, alone.used);
    EXPECT_LE(joined.trans_mean_m, kAsGood * alone.trans_mean_m);
    EXPECT_LE(joined.rot_mean_rad, kAsGood * alone.rot_mean_rad);
    EXPECT_GT(split.ties, 50);
  }

  CarmenLog log_;
  std::vector<Relation> relations_;
};

TEST_P(SplitLog, isJoinedAsWellAsOneRobotMapsItAlone) {
  pipeline::MappingState state(params_for(log_));
  const MappingRun whole = run_log(log_, state);
  expect_as_good(run_split(log_, whole.trajectory[log_.scans.size() / 2].pose), whole);
  const SplitRun unknown = run_split(log_, std::nullopt);
  ASSERT_TRUE(unknown.joined_share) << "not found in one another's maps";
  expect_as_good(unknown, whole);
}

INSTANTIATE_TEST_SUITE_P(Logs, SplitLog, ::testing::Values("intel", "fr079"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/table_runs.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "tests/unit/bench/table_reports.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::bench {
namespace {

using daemon::testing::TempDir;
using nlohmann::json;

const WorkerLimits kTwo{2, std::chrono::seconds(60)};

std::vector<PlannedRun> planned(int seeds) {
  std::vector<TableWorld> worlds{{"a.toml", "a", "fa", 50.0, {}}, {"b.toml", "b", "fb", 60.0, {}}};
  for (TableWorld& world : worlds) {
    for (int i = 0; i < seeds; ++i) world.starts.push_back({1.0 + i, 2.0, 0.0});
  }
  const std::vector<Entrant> entrants{{"topometric", 1}, {"min_pos", 1}};
  return plan_runs(worlds, entrants, testing::key_of("", "", 1, 0));
}

/// In place of an exploration: how long it takes is told by its world and seed.
types::Result<json> pretend(const PlannedRun& run) {
  return testing::good_report(run.key.entrant.robots, 10.0 * static_cast<double>(run.key.seed));
}

struct Counted : TableWatch {
  std::size_t there = 0, finishes = 0;
  std::vector<std::string> crashes;
  void begun(std::size_t /*all*/, std::size_t there_before) override { there = there_before; }
  void finished(const PlannedRun& /*run*/) override { ++finishes; }
  void crashed(const PlannedRun& /*run*/, const std::string& why) override { crashes.push_back(why); }
};

Counted done(const std::vector<PlannedRun>& runs, const std::string& file, const Exploration& explore) {
  auto log = RunLog::open(file);
  EXPECT_TRUE(log.has_value());
  Counted watch;
  const auto status = do_runs(runs, kTwo, explore, *log, watch);
  EXPECT_TRUE(status.has_value()) << (status ? "" : status.error().message);
  return watch;
}

std::vector<TableRun> results(const std::vector<PlannedRun>& runs, const std::string& file) {
  auto log = RunLog::open(file);
  EXPECT_TRUE(log.has_value());
  auto out = table_runs_of(runs, *log, Time::kT99);
  EXPECT_TRUE(out.has_value()) << (out ? "" : out.error().message);
  return std::move(*out);
}

TEST(PlannedRuns, haveWhatIsComparedTogetherAndOnOneStart) {
  const std::vector<PlannedRun> runs = planned(3);
  ASSERT_EQ(runs.size(), 2U * 3U * 2U);
  for (std::size_t i = 0; i < runs.size(); i += 2) {
    const RunKey &a = runs[i].key, &b = runs[i + 1].key;
    EXPECT_EQ(a.world, b.world);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.start, b.start);
    EXPECT_NE(a.entrant, b.entrant);
    EXPECT_EQ(a.start.x_m, static_cast<double>(a.seed));
  }
  EXPECT_EQ(runs.front().key.program, "p") << "what all have in common";
}

TEST(DoRuns, doesWhatIsMissingAndNothingTwice) {
  const TempDir folder;
  const std::string file = folder.file("runs.jsonl");
  EXPECT_EQ(done(planned(2), file, pretend).finishes, 8U);
  const Counted more = done(planned(3), file, pretend);
  EXPECT_EQ(more.there, 8U);
  EXPECT_EQ(more.finishes, 4U);
  const std::string text = daemon::testing::read_all(file);
  EXPECT_EQ(done(planned(3), file, pretend).finishes, 0U);
  EXPECT_EQ(daemon::testing::read_all(file), text) << "to the byte";
  EXPECT_EQ(results(planned(3), file).size(), 12U);
}

TEST(DoRuns, keepsTheReportButForMostOfItsCoverage) {
  const TempDir folder;
  const std::string file = folder.file("runs.jsonl");
  (void)done(planned(1), file, pretend);
  const TableRun run = results(planned(1), file).front();
  EXPECT_EQ(run.times_s.front(), 10.0);
  ASSERT_EQ(run.coverage.size(), 4U);
  EXPECT_EQ(run.coverage.front(), std::pair(5.0, 0.25));
  EXPECT_EQ(run.coverage.back(), std::pair(20.0, 1.0)) << "the last of them";
}

TEST(DoRuns, takesARunOfAnotherProgramForMissing) {
  const TempDir folder;
  const std::string file = folder.file("runs.jsonl");
  (void)done(planned(1), file, pretend);
  std::vector<PlannedRun> newer = planned(1);
  for (PlannedRun& run : newer) run.key.program = "newer";
  EXPECT_TRUE(results(newer, file).empty());
  EXPECT_EQ(done(newer, file, pretend).finishes, 4U);
  EXPECT_EQ(RunLog::open(file)->programs(), (std::set<std::string>{"newer", "p"}));
}

TEST(DoRuns, namesACrashCountsItAsAFailureAndTriesItAgain) {
  const TempDir folder;
  const std::string file = folder.file("runs.jsonl");
  const auto explore = [](const PlannedRun& run) -> types::Result<json> {
    if (run.key.world == "a" && run.key.entrant.strategy == "min_pos") ::raise(SIGKILL);
    if (run.key.world == "b" && run.key.entrant.strategy == "min_pos")
      return types::fail(types::Errc::kInvalidInput, "no room");
    return pretend(run);
  };
  const Counted watch = done(planned(1), file, explore);
  EXPECT_EQ(watch.crashes.size(), 2U);
  EXPECT_EQ(watch.finishes, 2U);
  std::vector<std::string> why;
  for (const TableRun& run : results(planned(1), file)) {
    EXPECT_EQ(run.failed, run.entrant.strategy == "min_pos");
    if (!run.failed) continue;
    why.push_back(run.why);
    EXPECT_EQ(run.times_s.back(), 1000.0) << "the limit";
  }
  EXPECT_EQ(why, (std::vector<std::string>{"no report: killed by signal 9 (Killed)", "no report: no room"}));
  EXPECT_EQ(done(planned(1), file, pretend).finishes, 2U);
  for (const TableRun& run : results(planned(1), file)) EXPECT_FALSE(run.failed) << "well the second time";
}

TEST(TableRuns, areThoseThatAreThere) {
  const TempDir folder;
  const std::string file = folder.file("runs.jsonl");
  (void)done(planned(1), file, pretend);
  EXPECT_EQ(results(planned(5), file).size(), 4U);
}

}  // namespace
}  // namespace topo::bench

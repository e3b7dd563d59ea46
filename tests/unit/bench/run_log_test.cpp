// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/run_log.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/unit/bench/table_reports.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::bench {
namespace {

using daemon::testing::read_all;
using daemon::testing::TempDir;
using nlohmann::json;

json run(std::uint64_t seed) { return json_of(testing::key_of("office", "topometric", 2, seed)); }

RunLog opened(const std::string& file) {
  auto log = RunLog::open(file);
  EXPECT_TRUE(log.has_value()) << (log ? "" : log.error().message);
  return std::move(*log);
}

TEST(RunLog, findsWhatWasAppended) {
  const TempDir folder;
  const std::string file = folder.file("runs.jsonl");
  {
    RunLog log = opened(file);
    EXPECT_EQ(log.find(run(1)), nullptr);
    ASSERT_TRUE(log.append(run(1), testing::good_report(2, 10.0)).has_value());
    ASSERT_TRUE(log.append(run(2), testing::good_report(2, 0.1)).has_value());
    ASSERT_NE(log.find(run(1)), nullptr);
  }
  const RunLog log = opened(file);
  EXPECT_EQ(log.size(), 2U);
  EXPECT_EQ(log.strange_lines(), 0U);
  ASSERT_NE(log.find(run(2)), nullptr);
  EXPECT_EQ(*log.find(run(2)), testing::good_report(2, 0.1)) << "to the last bit";
  EXPECT_EQ(log.find(run(3)), nullptr);
}

TEST(RunLog, takesNoRunForAnother) {
  const TempDir folder;
  RunLog log = opened(folder.file("runs.jsonl"));
  const RunKey key = testing::key_of("office", "topometric", 2, 1);
  ASSERT_TRUE(log.append(json_of(key), testing::good_report(2, 10.0)).has_value());
  std::vector<RunKey> others(10, key);
  others[0].world = "school";
  others[1].building = "rebuilt";
  others[2].program = "newer";
  others[3].entrant.strategy = "min_pos";
  others[4].entrant.robots = 3;
  others[5].seed = 2;
  others[6].start.theta_rad += 0.001;
  others[7].fidelity = "full";
  others[8].entrant.radio = "none";
  others[9].limit_s += 1.0;
  for (const RunKey& other : others) EXPECT_EQ(log.find(json_of(other)), nullptr) << json_of(other);
  EXPECT_NE(log.find(json_of(key)), nullptr);
}

TEST(RunLog, cutsOffATornLineWhereverItIsTorn) {
  const TempDir folder;
  const std::string whole = folder.file("whole.jsonl");
  {
    RunLog log = opened(whole);
    for (std::uint64_t seed = 1; seed <= 2; ++seed)
      ASSERT_TRUE(log.append(run(seed), testing::good_report(2, 10.0)).has_value());
  }
  const std::string text = read_all(whole);
  const std::size_t first = text.find('\n') + 1;
  for (std::size_t size = first; size < text.size(); size += 7) {
    const std::string torn = folder.write("torn.jsonl", text.substr(0, size));
    {
      RunLog log = opened(torn);
      EXPECT_NE(log.find(run(1)), nullptr);
      EXPECT_EQ(log.find(run(2)), nullptr) << size;
      EXPECT_EQ(log.strange_lines(), 0U);
      ASSERT_TRUE(log.append(run(2), testing::good_report(2, 10.0)).has_value());
    }
    ASSERT_EQ(read_all(torn), text) << "torn at " << size;
  }
}

TEST(RunLog, leavesStrangeLinesAlone) {
  const TempDir folder;
  const std::string strange = "{\"run\": 3}\n[]\nhello\n\n{\"run\": {}, \"report\": 0}\n";
  const std::string file = folder.write("runs.jsonl", strange);
  {
    RunLog log = opened(file);
    EXPECT_EQ(log.strange_lines(), 5U);
    EXPECT_EQ(log.size(), 0U);
    ASSERT_TRUE(log.append(run(1), testing::good_report(2, 10.0)).has_value());
  }
  EXPECT_EQ(read_all(file).substr(0, strange.size()), strange);
  EXPECT_EQ(opened(file).size(), 1U);
}

TEST(RunLog, isOfOneProgramAtATime) {
  const TempDir folder;
  const std::string file = folder.file("runs.jsonl");
  const RunLog log = opened(file);
  const pid_t other = ::fork();
  if (other == 0) {
    const auto second = RunLog::open(file);
    ::_exit(!second && second.error().code == types::Errc::kBusy ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(other, &status, 0), other);
  EXPECT_EQ(status, 0);
}

TEST(RunLog, saysWhereItCannotBe) {
  const auto log = RunLog::open("/nowhere/runs.jsonl");
  ASSERT_FALSE(log.has_value());
  EXPECT_NE(log.error().message.find("/nowhere/runs.jsonl"), std::string::npos) << log.error().message;
}

}  // namespace
}  // namespace topo::bench

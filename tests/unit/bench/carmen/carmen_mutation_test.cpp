// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Damaged input of every kind is refused or read, never a crash, a hang or a read outside (run under ASan and
// UBSan).
#include <gtest/gtest.h>

#include <random>

#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/carmen/relations.hpp"
#include "tests/unit/bench/carmen/sample_log.hpp"
#include "tests/unit/daemon/support/mutate.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::bench {
namespace {

template <class Read>
void survive(const std::string& good, Read read) {
  const daemon::testing::TempDir dir;
  std::mt19937 random(7);  // NOLINT: the same damage every time
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    const auto got = read(dir.write("mutant", daemon::testing::mutate(good, 30, random)));
    if (got.has_value()) continue;
    ++refused;
    EXPECT_NE(got.error().message.find("mutant"), std::string::npos) << got.error().message;
  }
  EXPECT_GT(refused, 20);
}

TEST(CarmenMutation, LogReaderSurvives) {
  for (const std::string& good :
       {testing::kSampleLog, testing::bzip2(testing::kSampleLog), testing::gzip(testing::kSampleLog)}) {
    survive(good, [](const std::string& path) {
      return read_carmen_log(
          path, {.beams = BeamAngles{.first_rad = -1.5, .step_rad = 0.5}, .odometry_gap_max_s = 1.0});
    });
  }
}

TEST(CarmenMutation, MinesReaderSurvives) {
  std::string line = "1000 0 10 20";
  for (int i = 0; i < 20 + 682; ++i) line += " " + std::to_string(i);
  survive(line + "\n" + line + "\n", read_mines_log);
}

TEST(CarmenMutation, RelationsReaderSurvives) {
  survive("# c\n1 2 0.5 0.25 0 0 0 0.1\n2 3 0.5 0.25 0 0 0 0.1\n", read_relations);
}

}  // namespace
}  // namespace topo::bench

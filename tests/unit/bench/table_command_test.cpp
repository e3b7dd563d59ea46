// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/table_command.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::bench {
namespace {

using daemon::testing::TempDir;

TableCommand command(const TempDir& folder) {
  TableCommand out;
  out.worlds = {"nowhere.toml"};
  out.out = folder.str();
  return out;
}

std::string error_of(const TableCommand& command) {
  const auto status = run_table(command);
  EXPECT_FALSE(status.has_value());
  return status ? "" : status.error().message;
}

template <class Change>
std::string error_after(Change&& change) {
  const TempDir folder;
  TableCommand changed = command(folder);
  change(changed);
  return error_of(changed);
}

TEST(TableCommand, refusesWhatCannotBeRunAndNamesTheOption) {
  EXPECT_NE(error_after([](auto& c) {
              c.strategies = {"topometric", "luck"};
            }).find("luck"),
            std::string::npos);
  EXPECT_NE(error_after([](auto& c) {
              c.strategies = {"min_pos", "min_pos"};
            }).find("--strategies"),
            std::string::npos);
  for (const std::vector<int>& robots :
       {std::vector{0}, std::vector{9}, std::vector{2, 2}, std::vector<int>{}})
    EXPECT_NE(error_after([&](auto& c) { c.robots = robots; }).find("--robots"), std::string::npos);
  EXPECT_NE(error_after([](auto& c) { c.seeds = 0; }).find("--seeds: found 0"), std::string::npos);
  for (const double limit_s : {0.0, 1e10, HUGE_VAL, std::nan("")})
    EXPECT_NE(error_after([&](auto& c) { c.limit_s = limit_s; }).find("--limit"), std::string::npos);
  EXPECT_NE(error_after([](auto& c) { c.wall_limit_s = 0; }).find("--wall-limit"), std::string::npos);
  EXPECT_NE(error_after([](auto& c) { c.radios = {"perfect", "smoke"}; }).find("smoke"), std::string::npos);
  EXPECT_NE(error_after([](auto& c) { c.radios = {"none", "none"}; }).find("--radio"), std::string::npos);
  EXPECT_NE(error_after([](auto& c) { c.share = "t42"; }).find("--share: found t42"), std::string::npos);
  EXPECT_NE(error_after([](auto& c) { c.fidelity = "full"; }).find("--fidelity: found full"),
            std::string::npos);
  EXPECT_NE(error_after([](auto& c) { c.compare = {"topometric:7/min_pos:7"}; }).find("topometric:7"),
            std::string::npos);
  EXPECT_NE(error_after([](auto&) {}).find("nowhere.toml"), std::string::npos);
}

TEST(TableCommand, takesASuiteInPlaceOfWorlds) {
  EXPECT_NE(error_after([](auto& c) { c.worlds = {}; }).find("--worlds: expected worlds, or --suite fresh"),
            std::string::npos);
  EXPECT_NE(error_after([](auto& c) { c.suite = "fresh"; }).find("--worlds"), std::string::npos)
      << "not both";
  const auto fresh = [](auto& c) {
    c.worlds = {};
    c.suite = "fresh";
  };
  EXPECT_NE(error_after(fresh).find("--suite-seed"), std::string::npos) << "the seed has to be named";
  EXPECT_NE(error_after([&](auto& c) {
              fresh(c);
              c.suite_seed = 5;
              c.buildings = 0;
            }).find("--buildings: found 0"),
            std::string::npos);
  EXPECT_NE(error_after([](auto& c) { c.suite_seed = 5; }).find("--suite-seed"), std::string::npos);
  EXPECT_NE(error_after([](auto& c) { c.suite = "dev"; }).find("aaf_y3"), std::string::npos);
}

TEST(TableCommand, runsOfSeveralProgramsNeedOneNamed) {
  const TempDir folder;
  (void)folder.write("runs.jsonl",
                     "{\"run\": {\"program\": \"one\"}, \"report\": {}}\n"
                     "{\"run\": {\"program\": \"other\"}, \"report\": {}}\n");
  TableCommand summary = command(folder);
  summary.no_runs = true;
  const std::string error = error_of(summary);
  EXPECT_NE(error.find("one, other"), std::string::npos) << error;
  EXPECT_NE(error.find("--program"), std::string::npos) << error;
}

TEST(TableCommand, saysWhenNothingIsThereToMakeATableOf) {
  const TempDir folder;
  TableCommand summary = command(folder);
  summary.worlds = {folder.write(
      "room.toml",
      "name = \"room\"\n[[start]]\nx_m = 2.0\ny_m = 3.0\n[[wall]]\n"
      "points_m = [[0.0, 0.0], [9.0, 0.0], [9.0, 6.0], [0.0, 6.0]]\nclosed = true\nthickness_m = 0.2\n")};
  summary.no_runs = true;
  const std::string error = error_of(summary);
  EXPECT_NE(error.find("found none of the 80 runs"), std::string::npos) << error;
}

}  // namespace
}  // namespace topo::bench

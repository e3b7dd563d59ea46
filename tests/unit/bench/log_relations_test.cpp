// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/log_relations.hpp"

#include <gmock/gmock.h>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::bench {
namespace {

using ::testing::HasSubstr;

CarmenLog log_with_stamps(std::initializer_list<double> stamps_s) {
  CarmenLog log;
  for (const double stamp_s : stamps_s) log.scans.emplace_back().stamp_s = stamp_s;
  return log;
}

TEST(LogRelations, AreTakenWhenOneIsAboutTheLog) {
  const daemon::testing::TempDir dir;
  const std::string path = dir.write("r", "1 2 0 0 0 0 0 0\n70 80 0 0 0 0 0 0\n");
  const auto relations = read_relations_of(log_with_stamps({1.0, 2.0, 3.0}), path);
  ASSERT_TRUE(relations.has_value()) << relations.error().message;
  EXPECT_EQ(relations->size(), 2U);
}

TEST(LogRelations, OfAnotherBuildingAreRefused) {
  const daemon::testing::TempDir dir;
  // Of the second, one stamp alone is in the log.
  const std::string path = dir.write("far.relations", "70 80 0 0 0 0 0 0\n2 80 0 0 0 0 0 0\n");
  const auto relations = read_relations_of(log_with_stamps({1.0, 2.0, 3.0}), path);
  ASSERT_FALSE(relations.has_value());
  EXPECT_EQ(relations.error().code, types::Errc::kInvalidInput);
  EXPECT_THAT(relations.error().message, HasSubstr("far.relations: none of 2 relations has its stamps"));
  EXPECT_THAT(relations.error().message, HasSubstr("found 70.000 and 80.000"));
  EXPECT_THAT(relations.error().message, HasSubstr("expected stamps from 1.000 to 3.000"));
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/segment_command.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "tests/bench/topobench/analyse/label_picture.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::bench {
namespace {

using ::testing::HasSubstr;

SegmentCommand command_of(const std::filesystem::path& labels, const std::filesystem::path& truth) {
  SegmentCommand command;
  command.labels = labels;
  command.truth = truth;
  return command;
}

TEST(SegmentCommand, WritesNoLabelsOverMapsOrTruth) {
  const daemon::testing::TempDir maps, truth;
  ASSERT_TRUE(save_labels(maps.file("map.png"), {2, 1, false, {1, 2}}).has_value());
  ASSERT_TRUE(save_labels(truth.file("map.png"), {2, 1, false, {1, 2}}).has_value());
  for (const std::string& labels : {maps.str(), truth.str()}) {
    SegmentCommand command = command_of(labels, truth.str());
    command.maps = maps.str();
    const auto refused = run_segment(command);
    ASSERT_FALSE(refused.has_value());
    EXPECT_THAT(refused.error().message, HasSubstr("expected another folder"));
  }
  EXPECT_FALSE(std::filesystem::exists(maps.file("overlay")));
  EXPECT_FALSE(std::filesystem::exists(truth.file("overlay")));
}

TEST(SegmentCommand, RefusesATurnThatIsNone) {
  SegmentCommand command = command_of("labels", "truth");
  command.turn_deg = std::nan("");
  const auto refused = run_segment(command);
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("--turn: found nan"));
}

TEST(SegmentCommand, NothingToScoreIsNoScore) {
  const daemon::testing::TempDir labels, truth;
  const auto empty = run_segment(command_of(labels.str(), truth.str()));
  ASSERT_FALSE(empty.has_value());
  EXPECT_THAT(empty.error().message, HasSubstr("found 0 pictures"));
  ASSERT_TRUE(save_labels(labels.file("map.png"), {2, 1, false, {1, 2}}).has_value());
  for (const std::string& other : {truth.str(), truth.file("missing")}) {
    const auto unlike = run_segment(command_of(labels.str(), other));
    ASSERT_FALSE(unlike.has_value());
    EXPECT_EQ(unlike.error().code, types::Errc::kNotFound);
    EXPECT_THAT(unlike.error().message, HasSubstr("found 1 pictures"));
  }
  const auto missing = run_segment(command_of(labels.file("missing"), truth.str()));
  ASSERT_FALSE(missing.has_value());
  EXPECT_THAT(missing.error().message, HasSubstr("expected a folder of PNG files"));
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/silence_control.hpp"

#include <gmock/gmock.h>
#include <poll.h>

#include <filesystem>
#include <optional>

#include "daemon/estop/latch_file.hpp"
#include "drivers/io/posix.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class SilenceControlTest : public ::testing::Test {
 protected:
  /// As one life of the daemon.
  void begin(const std::string& state_folder) {
    control.reset();
    base = {};
    control.emplace([this]() -> const pipeline::ControlReport& { return base; }, state_folder);
    ASSERT_TRUE(control->start());
  }
  void SetUp() override { begin(folder.str()); }

  void report(bool disobeys) {
    now += 100ms;
    base.stamp = now;
    base.plausibility.doubts.set(static_cast<std::size_t>(plausibility::Doubt::kDisobeys), disobeys);
    control->tick(now);
  }
  /// Until the thread has done something.
  void wait_for_the_file() {
    ASSERT_GT(io::wait_for(control->fd(), POLLIN, 10s), 0);
    control->tick(now);
  }

  testing::TempDir folder;
  std::string path = silence_path(folder.str());
  pipeline::ControlReport base;
  types::Stamp now{1000s};
  std::optional<SilenceControl> control;
};

TEST_F(SilenceControlTest, AnObedientBaseLeavesNoFile) {
  report(false);
  begin(folder.str());
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(control->trouble(), "");
}

TEST_F(SilenceControlTest, DisobedienceIsKeptAndForgottenWithItsDoubt) {
  report(true);
  wait_for_the_file();
  EXPECT_TRUE(read_latch(path).latched);
  EXPECT_THAT(read_latch(path).text, HasSubstr("moves otherwise than commanded"));
  report(false);
  wait_for_the_file();
  EXPECT_FALSE(read_latch(path).latched);
}

TEST_F(SilenceControlTest, StaysOverAnEndBeforeTheFirstReport) {
  report(true);
  wait_for_the_file();
  begin(folder.str());
  control->tick(now);  // no report yet: nothing is concluded
  begin(folder.str());
  EXPECT_TRUE(read_latch(path).latched);
  report(true);
  report(false);
  wait_for_the_file();
  EXPECT_FALSE(read_latch(path).latched);
}

TEST_F(SilenceControlTest, NotKeptIsToldUntilItIsKept) {
  begin(folder.file("missing"));
  report(true);
  wait_for_the_file();
  EXPECT_THAT(control->trouble(), HasSubstr("NOT kept over a restart"));
  EXPECT_THAT(control->trouble(), HasSubstr("missing"));
  std::filesystem::create_directory(folder.file("missing"));
  for (int tries = 0; tries < 10 && !control->trouble().empty(); ++tries) wait_for_the_file();
  EXPECT_EQ(control->trouble(), "");
}

TEST_F(SilenceControlTest, ForgettingIsTriedAgain) {
  std::filesystem::create_directory(path);  // stands for a disk that refuses
  begin(folder.str());
  report(false);
  wait_for_the_file();
  EXPECT_THAT(control->trouble(), HasSubstr("taken for disobedient"));
  std::filesystem::remove(path);
  now += 1s;
  report(false);
  wait_for_the_file();
  EXPECT_EQ(control->trouble(), "");
}

TEST_F(SilenceControlTest, WithoutAFolderNothingIsKept) {
  begin("");
  report(true);
  EXPECT_EQ(control->trouble(), "");
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/estop_control.hpp"

#include <gmock/gmock.h>
#include <poll.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "daemon/estop/latch_file.hpp"
#include "drivers/io/posix.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class EStopControlTest : public ::testing::Test {
 protected:
  /// As one life of the daemon.
  void begin(const std::string& state_folder) {
    control.reset();
    line.emplace();
    base = {};
    events.clear();
    control.emplace(
        *line, [this]() -> const pipeline::ControlReport& { return base; }, state_folder,
        [this](const Json& event) { events.push_back(event); });
    ASSERT_TRUE(control->start());
  }
  void SetUp() override { begin(folder.str()); }

  void collect_until(const std::function<bool()>& true_now) {
    for (int tries = 0; tries < 100 && !true_now(); ++tries) {
      ASSERT_GT(io::wait_for(control->fd(), POLLIN, 10s), 0);
      control->collect();
    }
    EXPECT_TRUE(true_now());
  }
  [[nodiscard]] std::string kept() const { return control->json()["kept"]; }
  void press_and_keep() {
    control->press();
    collect_until([this] { return kept() == "yes"; });
  }
  void clear() {
    cleared.reset();
    control->clear([this](const types::Status& status) { cleared = status; });
  }

  testing::TempDir folder;
  std::string path = latch_path(folder.str());
  std::optional<sync::EStopLine<>> line;
  pipeline::ControlReport base;
  std::vector<Json> events;
  std::optional<EStopControl> control;
  std::optional<types::Status> cleared;
};

TEST_F(EStopControlTest, BeginsReleased) {
  EXPECT_FALSE(control->latched());
  EXPECT_EQ(control->obstacle(), "");
  EXPECT_EQ(kept(), "");
}

TEST_F(EStopControlTest, PressStopsAtOnceAndIsKeptAfterwards) {
  control->press();
  EXPECT_TRUE(line->pressed());
  EXPECT_EQ(kept(), "not yet");
  collect_until([this] { return kept() == "yes"; });
  EXPECT_TRUE(read_latch(path).latched);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0]["event"], "estop_kept");
  EXPECT_EQ(events[0]["kept"], true);
}

TEST_F(EStopControlTest, OutlivesTheDaemonUntilItIsCleared) {
  press_and_keep();
  begin(folder.str());
  EXPECT_TRUE(line->pressed());
  EXPECT_THAT(control->obstacle(), HasSubstr("since before the daemon's start"));
  EXPECT_THAT(control->obstacle(), HasSubstr("topoctl clear-estop"));
  clear();
  EXPECT_TRUE(line->pressed()) << "released before the file was gone from the disk";
  collect_until([this] { return cleared.has_value(); });
  EXPECT_TRUE(*cleared);
  EXPECT_FALSE(line->pressed());
  EXPECT_FALSE(std::filesystem::exists(path));
  begin(folder.str());
  EXPECT_FALSE(control->latched());
}

TEST_F(EStopControlTest, KeptEvenWhenTheDaemonEndsAtOnce) {
  control->press();
  begin(folder.str());
  EXPECT_TRUE(line->pressed());
}

TEST_F(EStopControlTest, DamagedFileIsLatchedAndMended) {
  (void)folder.write("estop.latch", "topometric");
  begin(folder.str());
  EXPECT_TRUE(line->pressed());
  EXPECT_THAT(control->obstacle(), HasSubstr("damaged"));
  collect_until([this] { return kept() == "yes" && !read_latch(path).damaged; });
}

TEST_F(EStopControlTest, NotKeptIsToldWithTheReason) {
  begin(folder.file("missing"));
  control->press();
  EXPECT_TRUE(line->pressed());
  collect_until([this] { return kept() == "no"; });
  EXPECT_THAT(control->trouble(), HasSubstr("not kept over a restart"));
  EXPECT_THAT(control->trouble(), HasSubstr("missing"));
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0]["kept"], false);
  std::filesystem::create_directory(folder.file("missing"));
  collect_until([this] { return kept() == "yes"; });
  EXPECT_EQ(control->trouble(), "");
}

TEST_F(EStopControlTest, WithoutAFolderItSaysSo) {
  begin("");
  control->press();
  EXPECT_TRUE(line->pressed());
  EXPECT_EQ(kept(), "no");
  EXPECT_THAT(control->json()["why"], HasSubstr("control.state_folder"));
  clear();
  ASSERT_TRUE(cleared && *cleared);
  EXPECT_FALSE(line->pressed());
}

TEST_F(EStopControlTest, StaysLatchedWhenTheFileCannotBeRemoved) {
  std::filesystem::create_directory(path);  // stands for a disk that refuses
  begin(folder.str());
  ASSERT_TRUE(line->pressed());
  clear();
  collect_until([this] { return cleared.has_value(); });
  ASSERT_FALSE(*cleared);
  EXPECT_THAT(cleared->error().message, HasSubstr(path));
  EXPECT_TRUE(line->pressed());
  std::filesystem::remove(path);
  clear();
  collect_until([this] { return cleared.has_value(); });
  EXPECT_TRUE(*cleared);
  EXPECT_FALSE(line->pressed());
}

TEST_F(EStopControlTest, PressDuringAClearWins) {
  press_and_keep();
  clear();
  control->press();
  ASSERT_TRUE(cleared.has_value());
  EXPECT_FALSE(*cleared);
  collect_until([this] { return kept() == "yes"; });
  EXPECT_TRUE(line->pressed());
  EXPECT_TRUE(read_latch(path).latched);
}

TEST_F(EStopControlTest, TheStopButtonIsKeptTooAndAnOldReportIsNot) {
  base.estop_latched = true;
  base.stamp = io::monotonic_now();
  control->tick();
  collect_until([this] { return kept() == "yes"; });
  clear();
  collect_until([this] { return cleared.has_value(); });
  EXPECT_FALSE(control->latched());
  control->tick();
  EXPECT_EQ(kept(), "") << "a report from before the clear";
  base.stamp = io::monotonic_now() + 1s;
  control->tick();
  collect_until([this] { return kept() == "yes"; });
}

}  // namespace
}  // namespace topo::daemon

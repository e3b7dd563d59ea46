// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/radio_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

namespace topo::daemon {
namespace {

constexpr std::uint64_t kRun = 77;
const LinkIdentity kHere{.team = 1, .robot = 7, .version = kLinkVersion};

RadioHead from(std::uint16_t robot, std::uint64_t run, std::uint64_t number) {
  return {.version = kRadioVersion, .robot = robot, .team = 1, .run = run, .number = number, .writer = robot};
}

TEST(RadioFilter, LetsAMatesDatagramThroughOnce) {
  RadioFilter filter(kHere, kRun);
  EXPECT_EQ(filter.refuse(from(2, 5, 1), 100), std::nullopt);
  EXPECT_EQ(filter.refuse(from(2, 5, 1), 100), LinkDrop::kRepeated);
  EXPECT_EQ(filter.refuse(from(3, 5, 1), 100), std::nullopt);
}

TEST(RadioFilter, NamesWhatIsWrong) {
  RadioFilter filter(kHere, kRun);
  RadioHead head = from(2, 5, 1);
  head.version = kRadioVersion + 1;
  head.team = 2;
  EXPECT_EQ(filter.refuse(head, 100), LinkDrop::kOtherVersion);
  head.version = kRadioVersion;
  EXPECT_EQ(filter.refuse(head, 100), LinkDrop::kOtherTeam);
  EXPECT_EQ(filter.refuse(from(0, 5, 1), 100), LinkDrop::kMalformed);
  EXPECT_EQ(filter.refuse(from(251, 5, 1), 100), LinkDrop::kMalformed);
  EXPECT_EQ(filter.refuse(from(65535, 5, 1), 100), LinkDrop::kMalformed);
  EXPECT_EQ(filter.refuse(from(2, 5, 0), 100), LinkDrop::kMalformed);
  EXPECT_EQ(filter.refuse(from(2, 5, 1), 0), LinkDrop::kMalformed);
  EXPECT_EQ(filter.refuse(from(2, 5, 1), kDatagramMax_bytes + 1), LinkDrop::kMalformed);
  EXPECT_EQ(filter.refuse(from(2, 5, 1), kDatagramMax_bytes), std::nullopt);
}

TEST(RadioFilter, OwnNumberFromAnotherRobotIsSeen) {
  RadioFilter filter(kHere, kRun);
  EXPECT_EQ(filter.refuse(from(7, kRun + 1, 1), 100), LinkDrop::kOwnNumber);
  EXPECT_EQ(filter.refuse(from(7, kRun, 1), 100), LinkDrop::kRepeated);
}

TEST(RadioFilter, ANumberThatIsNotTheWritersIsRefused) {
  RadioFilter filter(kHere, kRun);
  for (const std::uint16_t writer : std::vector<std::uint16_t>{0, 3, 7, 250}) {
    RadioHead head = from(2, 5, 1);
    head.writer = writer;
    EXPECT_EQ(filter.refuse(head, 100), LinkDrop::kFalseNumber) << writer;
    head.robot = kHere.robot;
    if (writer != kHere.robot) {
      EXPECT_EQ(filter.refuse(head, 100), LinkDrop::kFalseNumber) << "it makes no double of this robot";
    }
  }
  EXPECT_EQ(filter.refuse(from(2, 5, 1), 100), std::nullopt) << "what was refused is not taken for received";
}

TEST(RobotPartition, HasOneNameForEachNumber) {
  for (std::uint16_t robot = 1; robot <= kRobotMax; ++robot)
    EXPECT_EQ(robot_of_partition(robot_partition(robot)), robot);
  for (const char* other : {"", "*", "robot-", "robot-0", "robot-251", "robot-07", "robot-7 ", "robot--7",
                            "robot-65543", "Robot-7", "xrobot-7", "robot-7*"})
    EXPECT_EQ(robot_of_partition(other), 0) << other;
}

TEST(RadioFilter, AMateThatBeginsAnewCountsFromOne) {
  RadioFilter filter(kHere, kRun);
  EXPECT_EQ(filter.refuse(from(2, 5, 1000), 100), std::nullopt);
  EXPECT_EQ(filter.refuse(from(2, 6, 1), 100), std::nullopt);
  EXPECT_EQ(filter.refuse(from(2, 6, 1), 100), LinkDrop::kRepeated);
}

TEST(ReplayWindow, ReachesSixtyFourBack) {
  ReplayWindow window;
  EXPECT_TRUE(window.take(100));
  EXPECT_TRUE(window.take(36));
  EXPECT_FALSE(window.take(35));
  EXPECT_FALSE(window.take(36));
  EXPECT_TRUE(window.take(164));
  EXPECT_FALSE(window.take(100)) << "the oldest that is still known";
  EXPECT_TRUE(window.take(1000));
  EXPECT_FALSE(window.take(164));
  EXPECT_TRUE(window.take(999));
  EXPECT_FALSE(window.take(999));
}

/// Against a set of all numbers ever taken.
TEST(ReplayWindow, IsASetAsFarAsItReaches) {
  std::mt19937 random(1);
  ReplayWindow window;
  std::set<std::uint64_t> taken;
  std::uint64_t base = 1;
  for (int i = 0; i < 20'000; ++i) {
    base += random() % 3;
    const std::uint64_t number = base + random() % 80;
    const std::uint64_t newest = taken.empty() ? 0 : *taken.rbegin();
    const bool fresh = !taken.contains(number) && (number > newest || newest - number <= 64);
    ASSERT_EQ(window.take(number), fresh) << number << " with " << newest;
    if (fresh) taken.insert(number);
  }
}

}  // namespace
}  // namespace topo::daemon

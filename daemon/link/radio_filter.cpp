// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/radio_filter.hpp"

#include <charconv>

namespace topo::daemon {

namespace {

constexpr std::string_view kPartition = "robot-";

}  // namespace

std::string robot_partition(std::uint16_t robot) { return std::string(kPartition) + std::to_string(robot); }

std::uint16_t robot_of_partition(std::string_view partition) {
  if (!partition.starts_with(kPartition)) return 0;
  const std::string_view digits = partition.substr(kPartition.size());
  std::uint16_t robot = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), robot);
  const bool whole = read.ec == std::errc() && read.ptr == digits.data() + digits.size();
  // A number has one name: "robot-07" is nobody's.
  return whole && robot <= kRobotMax && robot_partition(robot) == partition ? robot : std::uint16_t{0};
}

bool ReplayWindow::take(std::uint64_t number) {
  constexpr std::uint64_t kWidth = 64;
  if (number > newest_) {
    const std::uint64_t step = number - newest_;
    before_ = step > kWidth ? 0 : step == kWidth ? 0 : before_ << step;
    if (newest_ > 0 && step <= kWidth) before_ |= std::uint64_t{1} << (step - 1);
    newest_ = number;
    return true;
  }
  const std::uint64_t age = newest_ - number;
  if (age == 0 || age > kWidth) return false;
  const std::uint64_t bit = std::uint64_t{1} << (age - 1);
  if ((before_ & bit) != 0) return false;
  before_ |= bit;
  return true;
}

std::optional<LinkDrop> RadioFilter::refuse(const RadioHead& head, std::size_t content_bytes) {
  // The version first: what follows may mean something else in another one.
  if (head.version != kRadioVersion) return LinkDrop::kOtherVersion;
  if (head.team != own_.team) return LinkDrop::kOtherTeam;
  const bool whole = head.robot >= 1 && head.robot <= kRobotMax && head.number > 0 && content_bytes > 0 &&
                     content_bytes <= kDatagramMax_bytes;
  if (!whole) return LinkDrop::kMalformed;
  if (head.robot != head.writer) return LinkDrop::kFalseNumber;
  if (head.robot == own_.robot) return head.run == run_ ? LinkDrop::kRepeated : LinkDrop::kOwnNumber;
  Mate& mate = mates_[head.robot];
  if (mate.run != head.run) mate = {head.run, {}};
  if (!mate.received.take(head.number)) return LinkDrop::kRepeated;
  return {};
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/bus_faults.hpp"

namespace topo::io {

BusFaults& BusFaults::operator+=(const BusFaults& other) {
  for (std::size_t i = 0; i < kBusFaults; ++i) counts_[i] += other.counts_[i];
  return *this;
}

BusFaults& BusFaults::operator-=(const BusFaults& other) {
  for (std::size_t i = 0; i < kBusFaults; ++i) counts_[i] -= other.counts_[i];
  return *this;
}

const std::array<BusFaultName, kBusFaults>& bus_fault_names() {
  static constexpr std::array<BusFaultName, kBusFaults> kNames{{
      {BusFault::kBadMessage, "bad_messages", "a message that is no whole packet"},
      {BusFault::kBadTransfer, "bad_transfers", "frames from the robot missing or out of order"},
      {BusFault::kUnanswered, "unanswered", "a command given up because the robot did not take it"},
      {BusFault::kInterrupted, "interrupted", "a command given up for a stop"},
      {BusFault::kQueueFull, "queue_full", "no room in the interface's queue"},
      {BusFault::kDropped, "dropped", "a frame dropped because it was not fetched in time"},
      {BusFault::kPassive, "error_passive", "error passive: most frames fail"},
      {BusFault::kViolation, "bit_errors", "a bit error: noise, or a device with another bit rate"},
      {BusFault::kTransmitTimeout, "transmit_timeouts", "the controller does not get its frames out"},
      {BusFault::kOverflow, "overflows", "the controller lost frames"},
      {BusFault::kRestarted, "restarts", "the controller came back after bus-off"},
  }};
  return kNames;
}

std::string to_text(const BusFaults& faults) {
  std::string text;
  for (const auto& [fault, key, words] : bus_fault_names()) {
    if (faults[fault] == 0 || fault == BusFault::kInterrupted) continue;
    text.append(text.empty() ? "" : "; ").append(std::to_string(faults[fault])).append(" x ").append(words);
  }
  return text;
}

}  // namespace topo::io

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <utility>

#include "tests/sim/devices/sim_time.hpp"

namespace topo::sim {

/// A device's outgoing messages, each with its earliest send time. Messages leave in the order of push, as on
/// a real line.
class OutputQueue {
 public:
  explicit OutputQueue(std::size_t byte_limit) : byte_limit_(byte_limit) {}

  /// Queues a message that must not be lost (a reply). Returns false when the queue is full even for it.
  bool push(std::string message, SimTime due) { return push_below(std::move(message), due, 2 * byte_limit_); }

  /// Queues a message that may be lost (a scan, a SIP): with a slow client it is dropped completely and
  /// counted.
  bool push_droppable(std::string message, SimTime due) {
    if (copies_ > 1 || back_ > 0) push_again(message, due);
    if (push_below(std::move(message), due, byte_limit_)) return true;
    ++dropped_;
    return false;
  }

  /// A fault of the line: every message that may be lost leaves `copies` times; 1: once.
  void repeat(std::size_t copies) { copies_ = copies; }
  /// With every message that may be lost leaves the one that left `back` messages before; 0: none.
  void replay(std::size_t back) {
    back_ = back;
    history_.clear();
  }

  /// The bytes that may be sent now, at most max_bytes: the rest of the front message. Empty when none is
  /// due.
  [[nodiscard]] std::string_view peek(SimTime now, std::size_t max_bytes) const {
    if (messages_.empty() || messages_.front().due > now) return {};
    return std::string_view(messages_.front().bytes).substr(offset_, max_bytes);
  }

  /// Removes the first count bytes that peek() returned.
  void consume(std::size_t count) {
    offset_ += count;
    bytes_ -= count;
    if (offset_ < messages_.front().bytes.size()) return;
    messages_.pop_front();
    offset_ = 0;
  }

  void clear() {
    messages_.clear();
    offset_ = 0;
    bytes_ = 0;
  }

  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  struct Message {
    std::string bytes;
    SimTime due;
  };

  bool push_below(std::string message, SimTime due, std::size_t limit) {
    if (message.empty()) return true;
    if (bytes_ + message.size() > limit) return false;
    bytes_ += message.size();
    messages_.push_back({std::move(message), due});
    return true;
  }

  void push_again(const std::string& message, SimTime due) {
    for (std::size_t i = 1; i < copies_; ++i) push_below(message, due, byte_limit_);
    if (back_ == 0) return;
    history_.push_back(message);
    if (history_.size() <= back_) return;
    push_below(std::move(history_.front()), due, byte_limit_);
    history_.pop_front();
  }

  std::size_t copies_ = 1;
  std::size_t back_ = 0;
  std::deque<std::string> history_;  ///< while replaying
  std::deque<Message> messages_;
  std::size_t offset_ = 0;  ///< bytes of the front message already sent
  std::size_t bytes_ = 0;
  std::size_t byte_limit_;
  std::uint64_t dropped_ = 0;
};

}  // namespace topo::sim

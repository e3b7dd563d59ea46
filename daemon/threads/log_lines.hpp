// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <utility>

namespace topo::daemon {

/// Lines of the mission log on their way from main to the journal thread, which alone waits for the disk.
/// The lock is held for the copy of some lines by either, and by no other thread.
class LogLines {
 public:
  /// A disk that is full for an hour: half of what a robot says in that time.
  static constexpr std::size_t kBytesMax = 1U << 20U;

  /// One line with its line feed. False when there is no room: it is lost.
  bool add(const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() + line.size() > kBytesMax) return false;
    waiting_ += line;
    return true;
  }
  [[nodiscard]] std::string take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(waiting_, {});
  }
  /// What could not be written goes before what came since.
  void give_back(std::string lines) {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(lines) + waiting_;
  }

 private:
  std::mutex mutex_;
  std::string waiting_;  ///< guarded by mutex_
};

}  // namespace topo::daemon

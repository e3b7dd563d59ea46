// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "core/types/result.hpp"
#include "daemon/threads/thread.hpp"
#include "daemon/threads/wakeup.hpp"

namespace topo::daemon {

/// How the latch is kept and forgotten; both may block on a disk.
struct LatchStore {
  std::function<types::Status(const std::string& reason)> keep;
  std::function<types::Status()> forget;
};

/// A thread that keeps the latch, so that neither the robot's stop nor the answer to the operator waits for a
/// disk. Only the newest wish counts. Its lock is shared only by main and this thread, and never held while
/// the disk works.
class LatchKeeper {
 public:
  struct Done {
    std::uint64_t wish = 0;
    types::Status outcome;
  };

  explicit LatchKeeper(LatchStore store) : store_(std::move(store)) {}
  LatchKeeper(const LatchKeeper&) = delete;
  LatchKeeper& operator=(const LatchKeeper&) = delete;
  ~LatchKeeper() { stop(); }

  types::Status start();
  /// The newest wish is carried out before, once.
  void stop();

  // Main only.
  /// Returns the wish's number. Keeping is tried again every second until it succeeds or the wish changes.
  std::uint64_t keep(const std::string& reason) { return wish(true, reason); }
  std::uint64_t forget() { return wish(false, {}); }
  /// Readable when take_done() has news.
  [[nodiscard]] int fd() const { return finished_.fd(); }
  /// The newest outcome that was not taken yet.
  std::optional<Done> take_done();

 private:
  struct Wish {
    std::uint64_t number = 0;
    bool keep = false;
    std::string reason;
  };
  std::uint64_t wish(bool keep, const std::string& reason);
  void run();

  LatchStore store_;
  Wakeup wished_, finished_;
  std::mutex mutex_;
  Wish wish_;                 ///< guarded by mutex_
  std::optional<Done> done_;  ///< guarded by mutex_
  bool stopping_ = false;     ///< guarded by mutex_
  Thread thread_;
};

}  // namespace topo::daemon

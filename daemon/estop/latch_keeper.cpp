// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/estop/latch_keeper.hpp"

#include <utility>

namespace topo::daemon {

types::Status LatchKeeper::start() {
  ThreadSettings settings;
  settings.name = "latch";
  return thread_.start(settings, [this, settings] {
    (void)apply_settings(settings);
    run();
  });
}

void LatchKeeper::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wished_.post();
  thread_.join();
}

std::uint64_t LatchKeeper::wish(bool keep, const std::string& reason) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = wish_.number + 1;
    wish_ = {number, keep, reason};
  }
  wished_.post();
  return number;
}

std::optional<LatchKeeper::Done> LatchKeeper::take_done() {
  finished_.wait(types::Duration::zero());
  const std::lock_guard lock(mutex_);
  return std::exchange(done_, std::nullopt);
}

void LatchKeeper::run() {
  constexpr types::Duration kIdle = std::chrono::seconds(10);
  constexpr types::Duration kTryAgain = std::chrono::seconds(1);
  std::uint64_t tried = 0;
  bool succeeded = true;
  while (true) {
    const bool posted = wished_.wait(succeeded ? kIdle : kTryAgain);
    while (true) {
      Wish wish;
      {
        const std::lock_guard lock(mutex_);
        const bool again = !posted && !succeeded && wish_.keep && !stopping_;
        if (wish_.number == tried && !again) {
          if (stopping_) return;
          break;
        }
        wish = wish_;
      }
      const types::Status outcome = wish.keep ? store_.keep(wish.reason) : store_.forget();
      succeeded = outcome.has_value() || !wish.keep;
      const bool repeated = tried == wish.number;
      tried = wish.number;
      {
        const std::lock_guard lock(mutex_);
        done_ = Done{wish.number, outcome};
      }
      finished_.post();
      if (repeated) break;
    }
  }
}

}  // namespace topo::daemon

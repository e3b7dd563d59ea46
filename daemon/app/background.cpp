// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/background.hpp"

#include <utility>

namespace topo::daemon {

types::Status Background::start(const std::string& name) {
  ThreadSettings settings;
  settings.name = name;
  settings.nice = 5;
  settings.stack_bytes = 4 << 20;
  return thread_.start(settings, [this, settings] {
    (void)apply_settings(settings);
    run();
  });
}

void Background::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  job_ready_.post();
  thread_.join();
}

types::Status Background::add(Job job) {
  constexpr std::size_t kMostWaiting = 8;
  const std::lock_guard lock(mutex_);
  if (stopping_ || waiting_.size() >= kMostWaiting)
    return types::fail(types::Errc::kBusy, "too many of these wait already, or the daemon is stopping");
  waiting_.push_back(std::move(job));
  job_ready_.post();
  return {};
}

void Background::collect() {
  finished_ready_.wait(types::Duration::zero());
  std::deque<Finish> finished;
  {
    const std::lock_guard lock(mutex_);
    finished.swap(finished_);
  }
  for (const Finish& finish : finished) finish();
}

void Background::run() {
  while (true) {
    job_ready_.wait(std::chrono::seconds(10));
    while (true) {
      Job job;
      {
        const std::lock_guard lock(mutex_);
        if (stopping_) return;
        if (waiting_.empty()) break;
        job = std::move(waiting_.front());
        waiting_.pop_front();
      }
      Finish finish = job();
      {
        const std::lock_guard lock(mutex_);
        finished_.push_back(std::move(finish));
      }
      finished_ready_.post();
    }
  }
}

}  // namespace topo::daemon

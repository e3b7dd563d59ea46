// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <spdlog/logger.h>

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "core/sync/event_ring.hpp"

namespace topo::daemon {

/// Writes the events posted by real-time threads to the log. Used by the main thread: formatting allocates,
/// and a log's sink may lock and block.
class EventLog {
 public:
  explicit EventLog(std::shared_ptr<spdlog::logger> logger) : logger_(std::move(logger)) {}

  /// Logs the events in the ring, at most its capacity, and a warning when events were lost since the last
  /// call. Returns the number of events logged. `thread` is the name of the ring's thread, for the message.
  template <std::size_t N>
  std::size_t drain(std::string_view thread, sync::EventRing<N>& ring) {
    const std::size_t n = ring.drain([&](const sync::Event& event) { log(thread, event); });
    log_losses(thread, ring.lost());
    return n;
  }

  /// Number of lost events of all threads, as of their last drain().
  [[nodiscard]] std::uint64_t lost() const;

 private:
  void log(std::string_view thread, const sync::Event& event);
  void log_losses(std::string_view thread, std::uint64_t lost);

  std::shared_ptr<spdlog::logger> logger_;
  std::map<std::string, std::uint64_t, std::less<>> lost_;
};

}  // namespace topo::daemon

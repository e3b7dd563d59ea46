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

/// Brings what the real-time threads posted into the log. The main thread uses it: formatting allocates, and
/// a log's sink may lock and block.
class EventLog {
 public:
  explicit EventLog(std::shared_ptr<spdlog::logger> logger) : logger_(std::move(logger)) {}

  /// Logs what is in the ring, at most as much as it holds, and a warning when events found no room since the
  /// last call. Returns how many events were logged. `thread` is whose ring it is, for the message.
  template <std::size_t N>
  std::size_t drain(std::string_view thread, sync::EventRing<N>& ring) {
    const std::size_t n = ring.drain([&](const sync::Event& event) { log(thread, event); });
    log_losses(thread, ring.lost());
    return n;
  }

  /// Events of all threads that found no room, as far as they were told.
  [[nodiscard]] std::uint64_t lost() const;

 private:
  void log(std::string_view thread, const sync::Event& event);
  void log_losses(std::string_view thread, std::uint64_t lost);

  std::shared_ptr<spdlog::logger> logger_;
  std::map<std::string, std::uint64_t, std::less<>> lost_;
};

}  // namespace topo::daemon

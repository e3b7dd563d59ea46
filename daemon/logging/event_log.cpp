// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/logging/event_log.hpp"

#include "daemon/logging/event_catalogue.hpp"

namespace topo::daemon {

namespace {

spdlog::level::level_enum level_of(sync::Severity severity) {
  switch (severity) {
    case sync::Severity::kDebug:
      return spdlog::level::debug;
    case sync::Severity::kInfo:
      return spdlog::level::info;
    case sync::Severity::kWarning:
      return spdlog::level::warn;
    case sync::Severity::kError:
      break;
  }
  return spdlog::level::err;
}

}  // namespace

void EventLog::log(std::string_view thread, const sync::Event& event) {
  const auto level = level_of(event.severity);
  if (!logger_->should_log(level)) return;
  // The log adds the time of writing; the event's own time is appended.
  logger_->log(level, "{}: {} [at {:.6f} s]", thread, format_event(event),
               static_cast<double>(event.stamp_ns) * 1e-9);
}

void EventLog::log_losses(std::string_view thread, std::uint64_t lost) {
  auto known = lost_.find(thread);
  if (known == lost_.end()) known = lost_.emplace(std::string(thread), 0).first;
  if (lost == known->second) return;
  logger_->warn("{}: {} events found no room in the ring and are lost, {} since the start", thread,
                lost - known->second, lost);
  known->second = lost;
}

std::uint64_t EventLog::lost() const {
  std::uint64_t sum = 0;
  for (const auto& [thread, lost] : lost_) sum += lost;
  return sum;
}

}  // namespace topo::daemon

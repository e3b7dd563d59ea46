// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/sync/event_ring.hpp"

namespace topo::daemon {

/// Events of the real-time threads. The templates in event_catalogue.cpp define the meaning of an event's
/// three arguments and its text.
enum class EventId : std::uint16_t {
  kScanRingFull,
  kDeadlineMissed,
  kPlanningSlow,
  kJournalFailed,
  kJournalGoesOn,
  kOldJournalsRemoved,
  kTeam,
  kTwoRobotsOneNumber,
  kCount  ///< number of events
};

struct EventTemplate {
  std::string_view name;  ///< for filters and tests
  /// Syntax of fmt; {a} {b} {c} are the arguments, {a_ms} {b_ms} {c_ms} the arguments divided by a million
  /// (nanoseconds as milliseconds), {text} is the text.
  std::string_view message;
};

/// Nothing when the number is not an event.
[[nodiscard]] std::optional<EventTemplate> template_of(std::uint16_t id);

/// The event as one line for the log. Unprintable bytes of its text become '?': the text may come from a
/// device.
[[nodiscard]] std::string format_event(const sync::Event& event);

/// Posts from a real-time thread; wait-free, does not allocate. False when the ring is full; the ring counts
/// it.
template <std::size_t N>
bool post(sync::EventRing<N>& ring, std::int64_t stamp_ns, EventId id, sync::Severity severity,
          std::array<std::int64_t, 3> args = {}, std::string_view text = {}) noexcept {
  return ring.post(stamp_ns, static_cast<std::uint16_t>(id), severity, args, text);
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/sync/event_ring.hpp"

namespace topo::daemon {

/// What the real-time threads report. What an event's three arguments and its text mean is said by its
/// template in event_catalogue.cpp.
enum class EventId : std::uint16_t {
  kScanRingFull,
  kDeadlineMissed,
  kPlanningSlow,
  kJournalFailed,
  kJournalGoesOn,
  kCount  ///< how many there are; no event
};

struct EventTemplate {
  std::string_view name;  ///< for filters and tests
  /// fmt's syntax; {a} {b} {c} are the arguments, {a_ms} {b_ms} {c_ms} those divided by a million
  /// (nanoseconds as milliseconds), {text} is the text.
  std::string_view message;
};

/// Nothing when the number is no event.
[[nodiscard]] std::optional<EventTemplate> template_of(std::uint16_t id);

/// The event as one line for a person. Unprintable bytes of its text become '?': it may come from a wire.
[[nodiscard]] std::string format_event(const sync::Event& event);

/// Posts from a real-time thread; wait-free, does not allocate. False, and counted by the ring, when there is
/// no room.
template <std::size_t N>
bool post(sync::EventRing<N>& ring, std::int64_t stamp_ns, EventId id, sync::Severity severity,
          std::array<std::int64_t, 3> args = {}, std::string_view text = {}) noexcept {
  return ring.post(stamp_ns, static_cast<std::uint16_t>(id), severity, args, text);
}

}  // namespace topo::daemon

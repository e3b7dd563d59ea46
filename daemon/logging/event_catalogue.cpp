// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/logging/event_catalogue.hpp"

#include <fmt/format.h>

#include <array>

namespace topo::daemon {

namespace {

constexpr std::array kTemplates{
    EventTemplate{"scan_ring_full", "{text}: the mapping thread is behind: {a} scans lost since the start"},
    EventTemplate{"deadline_missed", "woke {a_ms:.1f} ms late, left out {b} periods"},
    EventTemplate{"planning_slow",
                  "planning took {a_ms:.0f} ms, the period is {b_ms:.0f} ms; {c} times since the start"},
    EventTemplate{"journal_failed", "the session is not being kept, {a} times since the start: {text}"},
    EventTemplate{"journal_goes_on", "the session is being kept again: {a} keyframes"},
    EventTemplate{"old_journals_removed", "{a} old journals of {b} MB are removed: session.quota_mb is {c}"},
    EventTemplate{"team", "{text}"},
    EventTemplate{"two_robots_one_number",
                  "two robots of the team have the number {a} (runs {b} and {c}): give one another robot.id"},
};
static_assert(kTemplates.size() == static_cast<std::size_t>(EventId::kCount));

std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  return out;
}

}  // namespace

std::optional<EventTemplate> template_of(std::uint16_t id) {
  if (id >= kTemplates.size()) return std::nullopt;
  return kTemplates[id];
}

std::string format_event(const sync::Event& event) {
  const auto& [a, b, c] = event.args;
  const std::string text = printable(event.text_view());
  const auto known = template_of(event.id);
  if (!known.has_value())
    return fmt::format("event {} without a name ({}, {}, {}) {}", event.id, a, b, c, text);
  const auto ms = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-6; };
  return fmt::format(fmt::runtime(known->message), fmt::arg("a", a), fmt::arg("b", b), fmt::arg("c", c),
                     fmt::arg("a_ms", ms(a)), fmt::arg("b_ms", ms(b)), fmt::arg("c_ms", ms(c)),
                     fmt::arg("text", text));
}

}  // namespace topo::daemon

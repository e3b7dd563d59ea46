// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/logging/event_catalogue.hpp"

#include <fmt/format.h>

#include <array>

namespace topo::daemon {

namespace {

constexpr std::array kTemplates{
    EventTemplate{"device_connected", "{text}: connected"},
    EventTemplate{"device_lost", "{text}: connection lost, {a} times since the start"},
    EventTemplate{"device_health", "{text}: health went from {a} to {b}"},
    EventTemplate{"device_wrong", "{text}: another device answers than the configured one"},
    EventTemplate{"device_resync",
                  "{text}: skipped {a} bytes of garbage, {b} checksum errors since the start"},
    EventTemplate{"scan_ring_full", "{text}: the mapping thread is behind: {a} scans lost since the start"},
    EventTemplate{"state_ring_full",
                  "the mapping thread is behind: {a} odometry readings lost since the start"},
    EventTemplate{"deadline_missed", "woke {a_ms:.1f} ms late, left out {b} periods"},
    EventTemplate{"planning_slow", "planning took {a_ms:.0f} ms, the period is {b_ms:.0f} ms"},
    EventTemplate{"scan_stale",
                  "stopped: the newest front scan is {a_ms:.0f} ms old, {b_ms:.0f} ms are allowed"},
    EventTemplate{"state_stale",
                  "stopped: the newest status of the base is {a_ms:.0f} ms old, {b_ms:.0f} ms are allowed"},
    EventTemplate{"plan_stale", "stopped: the plan is {a_ms:.0f} ms old, {b_ms:.0f} ms are allowed"},
    EventTemplate{"forward_sector_blind", "stopped: {a} of {b} beams ahead are valid, half are needed"},
    EventTemplate{"obstacle_stop", "stopped: something {a} mm ahead, {b} mm are needed"},
    EventTemplate{"estop", "emergency stop by {text}"},
    EventTemplate{"estop_cleared", "emergency stop cleared by {text}"},
    EventTemplate{"stall", "the wheels stall (left {a}, right {b})"},
    EventTemplate{"bumper", "bumpers touched: front {a:#04x}, rear {b:#04x}"},
    EventTemplate{"stop_button", "the stop button on the robot is pressed"},
    EventTemplate{"battery_low", "battery at {a} mV, low is {b} mV"},
    EventTemplate{"driving_refused", "will not drive: {text}"},
    EventTemplate{"thread_started", "started"},
    EventTemplate{"thread_ended", "ended"},
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

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/can_error.hpp"

#include <linux/can.h>
#include <linux/can/error.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "drivers/io/bus_faults.hpp"

namespace topo::io {

CanError decode_can_error(std::uint32_t id, std::span<const std::byte> data) {
  std::array<std::uint8_t, CAN_ERR_DLC> bytes{};
  for (std::size_t i = 0; i < std::min(data.size(), bytes.size()); ++i)
    bytes[i] = std::to_integer<std::uint8_t>(data[i]);
  const auto says = [id](std::uint32_t part) { return (id & part) != 0; };
  const unsigned controller = says(CAN_ERR_CRTL) ? bytes[1] : 0U;
  const auto controller_says = [controller](unsigned part) { return (controller & part) != 0; };
  CanError error;
  error.bus_off = says(CAN_ERR_BUSOFF);
  error.restarted = says(CAN_ERR_RESTARTED);
  error.passive = controller_says(CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE);
  error.overflow = controller_says(CAN_ERR_CRTL_RX_OVERFLOW | CAN_ERR_CRTL_TX_OVERFLOW);
  // Controllers report a missing acknowledgement in either of two places.
  const bool at_ack_slot = says(CAN_ERR_PROT) && bytes[3] == CAN_ERR_PROT_LOC_ACK;
  error.no_acknowledge = says(CAN_ERR_ACK) || at_ack_slot;
  error.transmit_timeout = says(CAN_ERR_TX_TIMEOUT);
  error.violation = says(CAN_ERR_PROT) && !at_ack_slot;
  // Older drivers fill in the counters with every change of state without setting CAN_ERR_CNT.
  if (says(CAN_ERR_CNT) || (says(CAN_ERR_CRTL) && (bytes[6] != 0 || bytes[7] != 0)))
    error.counters = CanErrorCounters{bytes[6], bytes[7]};
  return error;
}

std::string to_text(const CanErrorCounters& counters) {
  return "error counters: transmit " + std::to_string(counters.transmit) + ", receive " +
         std::to_string(counters.receive);
}

std::string to_text(const CanError& error) {
  const auto counted = [](BusFault fault) {
    return bus_fault_names()[static_cast<std::size_t>(fault)].words;
  };
  const std::array<std::pair<bool, std::string_view>, 7> words{{
      {error.bus_off, "bus-off: the controller took itself off the bus after too many errors"},
      {error.no_acknowledge, "nobody acknowledges what is sent"},
      {error.passive, counted(BusFault::kPassive)},
      {error.violation, counted(BusFault::kViolation)},
      {error.transmit_timeout, counted(BusFault::kTransmitTimeout)},
      {error.overflow, counted(BusFault::kOverflow)},
      {error.restarted, counted(BusFault::kRestarted)},
  }};
  std::string text;
  for (const auto& [holds, what] : words) {
    if (holds) text.append(text.empty() ? "" : "; ").append(what);
  }
  if (text.empty()) text = "nothing of importance";
  if (error.counters) text += " (" + to_text(*error.counters) + ")";
  return text;
}

}  // namespace topo::io

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "tests/sim/devices/output_queue.hpp"
#include "tests/sim/devices/sim_time.hpp"

namespace topo::sim {

/// A device at the end of a wire, without the wire: receives and sends bytes, without descriptor or clock.
class WireDevice {
 public:
  WireDevice() = default;
  WireDevice(const WireDevice&) = delete;
  WireDevice& operator=(const WireDevice&) = delete;
  virtual ~WireDevice() = default;

  /// Bytes from the client, split anywhere.
  virtual void receive(std::span<const std::uint8_t> bytes, SimTime now) = 0;
  /// Advances the device's own activities to this time.
  virtual void tick(SimTime now) = 0;
  /// A TCP client disconnected. Not called for a serial device, which cannot detect that.
  virtual void client_gone(SimTime now) = 0;
  /// Power off and on.
  virtual void power_cycle(SimTime now) = 0;
  /// Time for which the device leaves the wire from now on (a reboot); returned once.
  virtual std::optional<SimTime> take_absence(SimTime now) = 0;
  /// Speed of the device's serial port in bit/s; 0 where the speed has no meaning (USB, Ethernet).
  [[nodiscard]] virtual unsigned line_rate_bps() const = 0;

  [[nodiscard]] virtual OutputQueue& output() = 0;
};

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "tests/sim/devices/delay_line.hpp"
#include "tests/sim/devices/endpoint.hpp"
#include "tests/sim/devices/sim_time.hpp"
#include "tests/sim/devices/wire_device.hpp"

namespace topo::sim {

/// A device on its wire, with the wire's faults and the serial line's speed. A client that does not read does
/// not delay the simulation: the device's queue drops complete messages. Not thread-safe.
class Wire {
 public:
  /// device must outlive the wire.
  Wire(WireDevice& device, std::unique_ptr<Endpoint> endpoint, std::uint64_t seed);

  types::Status open() { return endpoint_->open(); }
  /// Moves bytes in both directions.
  void pump(SimTime now);
  void append_poll(std::vector<pollfd>& fds) const { endpoint_->append_poll(fds); }

  /// Suppresses the device's output until then.
  void silence(SimTime until) { silent_until_ = until; }
  /// Breaks the link until then.
  void cut(SimTime until);
  /// Limits the bytes per second to the client; 0: as fast as the wire.
  void slow(double bytes_per_s) { slow_bytes_per_s_ = bytes_per_s; }
  /// Drops this share of the bytes, in both directions.
  void drop(double rate) { drop_rate_ = rate; }
  /// Holds all bytes from, or to, the device; as DelayLine::set().
  void delay_from_device(SimTime constant, double growth, SimTime now) {
    from_device_.set(constant, growth, now);
  }
  void delay_to_device(SimTime constant, double growth, SimTime now) {
    to_device_.set(constant, growth, now);
  }
  /// As Endpoint::forget_client(): a half-open link.
  bool forget_client() { return endpoint_->forget_client(); }
  /// Inserts this number of random bytes into the device's output.
  void garbage(std::size_t bytes) { garbage_ += bytes; }

  [[nodiscard]] bool connected() const { return endpoint_->connected(); }
  [[nodiscard]] DeviceAddress address() const { return endpoint_->address(); }

 private:
  void notice_loss(SimTime now);
  void receive(SimTime now);
  void transmit(SimTime now);
  void stage(SimTime now);
  std::string next_piece(SimTime now);
  void discard_output(SimTime now);
  void spoil(std::string& bytes);
  [[nodiscard]] bool speeds_differ() const;
  [[nodiscard]] double bytes_per_s() const;

  WireDevice& device_;
  std::unique_ptr<Endpoint> endpoint_;
  std::mt19937_64 random_;
  bool was_connected_ = false;
  bool cut_ = false;
  SimTime cut_until_{0};
  SimTime silent_until_{0};
  double slow_bytes_per_s_ = 0.0;
  double drop_rate_ = 0.0;
  std::size_t garbage_ = 0;
  DelayLine from_device_, to_device_;
  std::string staged_;   ///< to be written, with faults already applied
  double credit_ = 0.0;  ///< bytes that the line's speed permits now
  SimTime last_{0};
};

}  // namespace topo::sim

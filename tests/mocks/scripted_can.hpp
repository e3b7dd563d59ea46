// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/io/can_port.hpp"

namespace topo::mocks {

/// A CAN bus on a clock of its own, with a test at its far end: waiting for a frame moves the clock. Its
/// interface has a queue of two bands, as the kernel's. One thread.
class ScriptedCan {
 public:
  struct Sent {
    std::uint16_t id = 0;
    std::string data;
    types::Stamp when{};
    bool first = false;  ///< past the queue
  };

  types::Stamp now{std::chrono::seconds(1000)};
  std::vector<Sent> sent;                    ///< in the order of the wire
  std::function<void(const Sent&)> on_sent;  ///< usually answers
  bool full = false;                         ///< the interface's queue takes nothing
  bool blocked = false;                      ///< the wire takes nothing: what is sent waits in the queue
  std::size_t capacity = 128;                ///< of each band
  std::uint64_t dropped = 0;                 ///< frames that nobody fetched
  std::string gone;                          ///< why everything fails; empty: it does not

  /// A frame arrives `delay` from now, not before those that were queued earlier.
  void arrive(std::uint16_t id, std::string_view data, types::Duration delay = {});
  void report(const io::CanError& error, types::Duration delay = {});
  [[nodiscard]] std::vector<std::string> sent_on(std::uint16_t id) const;
  /// The wire is free again: the queue goes out, the first band before the other.
  void unblock();

 private:
  friend class ScriptedCanPort;
  struct Coming {
    types::Stamp when;
    io::CanEvent event;
  };
  void add(io::CanEvent event, types::Duration delay);
  void put_on_wire(Sent frame);
  std::deque<Coming> coming_;
  std::deque<Sent> first_, others_;  ///< the two bands
};

/// The bus outlives it.
class ScriptedCanPort final : public io::CanPort {
 public:
  explicit ScriptedCanPort(ScriptedCan& bus) : bus_(bus) {}
  types::Result<io::CanEvent> receive(types::Duration timeout) override;
  types::Status send(std::uint16_t id, const io::CanData& data) override { return put(id, data, false); }
  types::Status send_first(std::uint16_t id, const io::CanData& data) override { return put(id, data, true); }
  [[nodiscard]] std::uint64_t dropped() const override { return bus_.dropped; }
  [[nodiscard]] types::Stamp now() const override { return bus_.now; }
  [[nodiscard]] std::string_view name() const override { return "can:scripted"; }

 private:
  types::Status put(std::uint16_t id, const io::CanData& data, bool first);
  ScriptedCan& bus_;
};

/// Bytes as they are written in a protocol's description: "10 2b fa".
[[nodiscard]] std::string frame_bytes(std::string_view text);

}  // namespace topo::mocks

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <poll.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::sim {

/// Where a client finds a device.
struct DeviceAddress {
  bool tcp = true;
  std::string host;            ///< TCP
  std::uint16_t port = 0;      ///< TCP
  std::filesystem::path path;  ///< pty: the link to the terminal
  std::string interface {};    ///< CAN; empty on other wires
  int unit = 0;                ///< CAN
};

/// The device's end of a wire. Nothing in it blocks. Not thread-safe.
class Endpoint {
 public:
  Endpoint() = default;
  Endpoint(const Endpoint&) = delete;
  Endpoint& operator=(const Endpoint&) = delete;
  virtual ~Endpoint() = default;

  /// Puts the device on its wire, again after close() at the same address.
  virtual types::Status open() = 0;
  /// Takes it off: a client sees its link break.
  virtual void close() = 0;
  /// Takes new clients and notices lost ones.
  virtual void service() = 0;
  /// Bytes read, 0 when there are none.
  virtual std::size_t read(std::span<std::uint8_t> into) = 0;
  /// Bytes taken, fewer than given when the client does not read.
  virtual std::size_t write(std::span<const char> bytes) = 0;
  /// What to wait for; nothing that would be ready all the time.
  virtual void append_poll(std::vector<pollfd>& fds) const = 0;

  [[nodiscard]] virtual bool connected() const = 0;
  /// True where bytes take time and a lost client goes unseen.
  [[nodiscard]] virtual bool serial() const = 0;
  /// The speed the client has set on its side of a serial line, bit/s; 0 when unknown.
  [[nodiscard]] virtual unsigned client_rate_bps() const = 0;
  [[nodiscard]] virtual DeviceAddress address() const = 0;
};

/// Listens on the loopback interface; port 0 takes any and keeps it. One client at a time: others are turned
/// away.
[[nodiscard]] std::unique_ptr<Endpoint> make_tcp_endpoint(std::uint16_t port);
/// A pseudo terminal with a symbolic link to it at `link`; an old link there is replaced, a file is not.
[[nodiscard]] std::unique_ptr<Endpoint> make_pty_endpoint(std::filesystem::path link);
/// A gateway on a CAN bus, as unit 0 to 7; `state` for its heartbeat: 0 wait, 1 synced, 2 open.
[[nodiscard]] std::unique_ptr<Endpoint> make_can_endpoint(std::string interface, int unit,
                                                          std::function<int()> state);

}  // namespace topo::sim

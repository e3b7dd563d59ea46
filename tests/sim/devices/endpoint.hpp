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

/// Address of a device for clients.
struct DeviceAddress {
  bool tcp = true;
  std::string host;            ///< TCP
  std::uint16_t port = 0;      ///< TCP
  std::filesystem::path path;  ///< pty: the link to the terminal
  std::string interface {};    ///< CAN; empty on other wires
  int unit = 0;                ///< CAN
};

/// The device's end of a wire. No call blocks. Not thread-safe.
class Endpoint {
 public:
  Endpoint() = default;
  Endpoint(const Endpoint&) = delete;
  Endpoint& operator=(const Endpoint&) = delete;
  virtual ~Endpoint() = default;

  /// Connects the device to its wire; after close() at the same address.
  virtual types::Status open() = 0;
  /// Disconnects the device: the client's link breaks.
  virtual void close() = 0;
  /// Forgets the client, whose link stays open: it is served no more and hears of no end. False where a line
  /// has no ends to forget (anything but TCP), or no client is there.
  virtual bool forget_client() { return false; }
  /// Accepts new clients and detects lost ones.
  virtual void service() = 0;
  /// Number of bytes read, 0 when there are none.
  virtual std::size_t read(std::span<std::uint8_t> into) = 0;
  /// Number of bytes taken; fewer than given when the client does not read.
  virtual std::size_t write(std::span<const char> bytes) = 0;
  /// Adds the descriptors to wait for, except those that would always be ready.
  virtual void append_poll(std::vector<pollfd>& fds) const = 0;

  [[nodiscard]] virtual bool connected() const = 0;
  /// True when bytes take time and a lost client is not detected.
  [[nodiscard]] virtual bool serial() const = 0;
  /// The speed that the client has set for a serial line, bit/s; 0 when unknown.
  [[nodiscard]] virtual unsigned client_rate_bps() const = 0;
  [[nodiscard]] virtual DeviceAddress address() const = 0;
};

/// Listens on the loopback interface; port 0 selects a free port and keeps it. Accepts one client at a time
/// and rejects others.
[[nodiscard]] std::unique_ptr<Endpoint> make_tcp_endpoint(std::uint16_t port);
/// A pseudo terminal with a symbolic link to it at `link`; replaces an old link, but not a file.
[[nodiscard]] std::unique_ptr<Endpoint> make_pty_endpoint(std::filesystem::path link);
/// A gateway on a CAN bus, as unit 0 to 7; `state` for its heartbeat: 0 wait, 1 synced, 2 open.
[[nodiscard]] std::unique_ptr<Endpoint> make_can_endpoint(std::string interface, int unit,
                                                          std::function<int()> state);

}  // namespace topo::sim

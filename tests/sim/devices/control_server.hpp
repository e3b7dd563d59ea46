// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <poll.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/types/result.hpp"
#include "drivers/io/unix_socket.hpp"
#include "tests/sim/devices/file_descriptor.hpp"

namespace topo::sim {

/// The simulation's control socket: one JSON object per line in both directions. No call blocks.
class ControlServer {
 public:
  using Handler = std::function<std::string(const std::string& line)>;

  /// As io::ListeningSocket::open(); only the user of the simulation may connect.
  static types::Result<std::unique_ptr<ControlServer>> listen(const std::filesystem::path& path);

  void serve(const Handler& handler);
  void append_poll(std::vector<pollfd>& fds) const;

 private:
  struct Client {
    FileDescriptor fd;
    std::string input;
    std::string output;
  };
  explicit ControlServer(io::ListeningSocket socket) : socket_(std::move(socket)) {}
  static bool serve_client(Client& client, const Handler& handler);

  io::ListeningSocket socket_;
  std::vector<Client> clients_;
};

/// Sends one line to a control socket and returns the answer; waits at most timeout_ms.
types::Result<std::string> ask_control(const std::filesystem::path& path, const std::string& line,
                                       int timeout_ms);

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <poll.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "tests/sim/devices/file_descriptor.hpp"

namespace topo::sim {

/// The simulation's control socket: one JSON object a line in, one a line out. Nothing in it blocks.
class ControlServer {
 public:
  using Handler = std::function<std::string(const std::string& line)>;

  /// Replaces an old socket at path; a file of another kind is left alone and is an error.
  static types::Result<std::unique_ptr<ControlServer>> listen(const std::filesystem::path& path);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  void serve(const Handler& handler);
  void append_poll(std::vector<pollfd>& fds) const;

 private:
  struct Client {
    FileDescriptor fd;
    std::string input;
    std::string output;
  };
  ControlServer(std::filesystem::path path, FileDescriptor listener);
  static bool serve_client(Client& client, const Handler& handler);

  std::filesystem::path path_;
  FileDescriptor listener_;
  std::vector<Client> clients_;
};

/// Sends one line to a control socket and returns the answer; waits at most timeout_ms.
types::Result<std::string> ask_control(const std::filesystem::path& path, const std::string& line,
                                       int timeout_ms);

}  // namespace topo::sim

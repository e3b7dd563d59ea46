// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"
#include "core/types/stamp.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {

/// A listening Unix stream socket in the file system, owned through a lock file beside it (PATH.lock), so
/// that a socket left by a crash is replaced and one of a living daemon never is. Removes the socket's file
/// when it goes.
class ListeningSocket {
 public:
  /// kBusy: another daemon serves this path. kInvalidInput: something that is no socket is there.
  static types::Result<ListeningSocket> open(const std::string& path);

  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;
  ListeningSocket(ListeningSocket&& other) noexcept = default;
  ListeningSocket& operator=(ListeningSocket&&) = delete;
  ~ListeningSocket();

  [[nodiscard]] int fd() const { return socket_.get(); }

 private:
  ListeningSocket(io::UniqueFd lock, io::UniqueFd socket, std::string path)
      : lock_(std::move(lock)), socket_(std::move(socket)), path_(std::move(path)) {}
  io::UniqueFd lock_;
  io::UniqueFd socket_;
  std::string path_;
};

/// Connects to a daemon. kNotFound: nobody serves there. kPermission: the file or its folder is closed to us.
/// kTimeout: it took nobody up within `patience`, the longest that later sends wait, too.
types::Result<io::UniqueFd> connect_unix(const std::string& path,
                                         types::Duration patience = std::chrono::seconds(5));

}  // namespace topo::daemon

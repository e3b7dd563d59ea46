// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>

#include "core/types/result.hpp"
#include "core/types/stamp.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::io {

/// A listening Unix stream socket in the file system, owned through a lock file beside it (PATH.lock), so
/// that a socket left by a crash is replaced and one of a living process never is. Removes the socket's file
/// when it goes.
class ListeningSocket {
 public:
  /// `mode`: who may connect. By default anybody: what a peer may do is decided by its credentials.
  /// kBusy: another process serves this path. kInvalidInput: something that is no socket is there.
  static types::Result<ListeningSocket> open(const std::string& path, mode_t mode = 0666);

  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;
  ListeningSocket(ListeningSocket&& other) noexcept = default;
  ListeningSocket& operator=(ListeningSocket&&) = delete;
  ~ListeningSocket();

  [[nodiscard]] int fd() const { return socket_.get(); }

 private:
  ListeningSocket(UniqueFd lock, UniqueFd socket, std::string path)
      : lock_(std::move(lock)), socket_(std::move(socket)), path_(std::move(path)) {}
  UniqueFd lock_;
  UniqueFd socket_;
  std::string path_;
};

/// Whose ListeningSocket is there, be it one that takes nobody up; 0 when that is nobody's, our own, or that
/// of a process that we cannot name.
[[nodiscard]] pid_t serving_process(const std::string& path);

/// Connects to who serves there. kNotFound: nobody does. kPermission: the file or its folder is closed to us.
/// kTimeout: it took nobody up within `patience`, the longest that later sends wait, too.
types::Result<UniqueFd> connect_unix(const std::string& path,
                                     types::Duration patience = std::chrono::seconds(5));

}  // namespace topo::io

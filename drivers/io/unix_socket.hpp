// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <string>
#include <string_view>

#include "core/types/result.hpp"
#include "core/types/stamp.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::io {

/// What a socket carries, and its name in messages.
struct SocketKind {
  int type = SOCK_STREAM;
  std::string_view name = "control socket";
};

/// A listening Unix socket in the file system, owned through a lock file beside it (PATH.lock): a
/// socket left by a crash is replaced, a socket of a living process never is. The lock file belongs to the
/// user who runs the process and is open to nobody else. The destructor removes the socket's file.
class ListeningSocket {
 public:
  /// `mode`: permission to connect. By default any user: a peer's rights follow from its credentials. kBusy:
  /// another process serves this path. kInvalidInput: a file that is not a socket is there. kPermission: the
  /// lock file belongs to another user.
  static types::Result<ListeningSocket> open(const std::string& path, mode_t mode = 0666,
                                             const SocketKind& kind = {});

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

/// Process that owns the ListeningSocket at `path`, even when it accepts no connections; 0 when there is
/// none, when it is this process, or when its process id is not visible here: to its user and to root only.
[[nodiscard]] pid_t serving_process(const std::string& path);

/// Connects to the process that serves `path`. kNotFound: none does. kPermission: no access to the file or
/// its folder. kTimeout: not accepted within `patience`, which is also the limit of later sends.
types::Result<UniqueFd> connect_unix(const std::string& path,
                                     types::Duration patience = std::chrono::seconds(5),
                                     const SocketKind& kind = {});

}  // namespace topo::io

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/probe.hpp"

#include <poll.h>
#include <sys/socket.h>

#include "daemon/control/json_rpc.hpp"
#include "drivers/io/posix.hpp"
#include "drivers/io/unix_socket.hpp"

namespace topo::daemon {

namespace {

/// Who listens, as the kernel noted it when he began to.
pid_t listener(int connection) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 ? peer.pid : 0;
}

}  // namespace

Probe probe(const std::string& socket, types::Duration patience) {
  const auto connection = io::connect_unix(socket, patience);
  if (!connection && connection.error().code == types::Errc::kTimeout) return {Served::kByHung};
  if (!connection) return {};
  const pid_t pid = listener(connection->get());
  const std::string question = request_line("version", Json::object(), 1);
  if (::send(connection->get(), question.data(), question.size(), MSG_NOSIGNAL) < 0)
    return {Served::kByHung, pid};
  char answer = 0;
  const bool answers = io::wait_for(connection->get(), POLLIN, patience) > 0 &&
                       ::recv(connection->get(), &answer, 1, MSG_DONTWAIT) == 1;
  return {answers ? Served::kByLiving : Served::kByHung, pid};
}

}  // namespace topo::daemon

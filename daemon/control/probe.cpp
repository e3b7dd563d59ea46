// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/probe.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <optional>

#include "daemon/control/json_rpc.hpp"
#include "drivers/io/posix.hpp"
#include "drivers/io/unix_socket.hpp"

namespace topo::daemon {

namespace {

/// The listening process, as the kernel recorded it at listen().
pid_t listener(int connection) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 ? peer.pid : 0;
}

enum class Heard { kNothing, kAnAnswer, kHangingUp };

Heard ask(int connection, types::Duration patience) {
  const std::string question = request_line("version", Json::object(), 1);
  const bool sent = ::send(connection, question.data(), question.size(), MSG_NOSIGNAL) >= 0;
  if (sent && io::wait_for(connection, POLLIN, patience) <= 0) return Heard::kNothing;
  char answer = 0;
  return sent && ::recv(connection, &answer, 1, MSG_DONTWAIT) == 1 ? Heard::kAnAnswer : Heard::kHangingUp;
}

/// Nothing when the server closed the connection.
std::optional<Probe> probe_once(const std::string& socket, types::Duration patience) {
  const auto connection = io::connect_unix(socket, patience);
  if (!connection && connection.error().code == types::Errc::kTimeout)
    return Probe{Served::kByHung, io::serving_process(socket)};
  if (!connection) return Probe{};
  switch (ask(connection->get(), patience)) {
    case Heard::kAnAnswer:
      return Probe{Served::kByLiving, listener(connection->get())};
    case Heard::kNothing:
      return Probe{Served::kByHung, listener(connection->get())};
    case Heard::kHangingUp:
      break;
  }
  return {};
}

}  // namespace

Probe probe(const std::string& socket, types::Duration patience) {
  constexpr types::Duration kPause = std::chrono::milliseconds(20);
  const types::Stamp deadline = io::monotonic_now() + patience;
  for (;;) {
    if (const auto seen = probe_once(socket, patience)) return *seen;
    if (io::monotonic_now() >= deadline) return {Served::kByLiving};
    io::sleep_until(io::monotonic_now() + kPause);
  }
}

}  // namespace topo::daemon

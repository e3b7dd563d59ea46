// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/topoctl/client.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "drivers/io/posix.hpp"
#include "drivers/io/unix_socket.hpp"

namespace topo::daemon {

using types::Errc;
using types::fail;
using types::Result;

Result<Client> Client::connect(const std::string& socket, types::Duration patience) {
  auto fd = io::connect_unix(socket, patience);
  if (!fd) return tl::unexpected(fd.error());
  return Client(std::move(*fd));
}

Result<Json> Client::call(std::string_view method, const Json& params, types::Duration timeout) {
  const int id = next_id_++;
  const std::string line = request_line(method, params, id);
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t sent =
        io::retry_interrupted([&] { return ::send(fd_.get(), rest.data(), rest.size(), MSG_NOSIGNAL); });
    if (sent < 0 && errno == EAGAIN) return fail(Errc::kTimeout, "the daemon does not answer", errno);
    if (sent < 0)
      return fail(Errc::kClosed, fmt::format("the daemon hung up: {}", std::strerror(errno)), errno);
    rest.remove_prefix(static_cast<std::size_t>(sent));
  }
  const types::Stamp deadline = io::monotonic_now() + timeout;
  while (true) {
    const auto answer = read_line(deadline);
    if (!answer) return tl::unexpected(answer.error());
    auto event = parse_notification(*answer);
    if (!event) return parse_answer(*answer, id);
    events_.push_back(std::move(*event));
  }
}

Result<Json> Client::next_event(types::Duration timeout) {
  const types::Stamp deadline = io::monotonic_now() + timeout;
  while (events_.empty()) {
    const auto line = read_line(deadline);
    if (!line) return tl::unexpected(line.error());
    if (auto event = parse_notification(*line)) events_.push_back(std::move(*event));
  }
  Json event = std::move(events_.front());
  events_.pop_front();
  return event;
}

Result<std::string> Client::read_line(types::Stamp deadline) {
  std::array<char, 16384> bytes{};
  while (true) {
    if (auto line = in_.take_line()) return std::move(*line);
    const int ready = io::wait_for(fd_.get(), POLLIN, deadline - io::monotonic_now());
    if (ready == 0) return fail(Errc::kTimeout, "the daemon does not answer");
    const ssize_t got =
        io::retry_interrupted([&] { return ::recv(fd_.get(), bytes.data(), bytes.size(), 0); });
    if (got <= 0) return fail(Errc::kClosed, "the daemon hung up");
    if (!in_.append({bytes.data(), static_cast<std::size_t>(got)}))
      return fail(Errc::kProtocol, "endless answer");
  }
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/control_server.hpp"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace topo::sim {
namespace {

using types::Errc;

constexpr std::size_t kLongestLine = std::size_t{64} * 1024;
constexpr std::size_t kMostClients = 16;
constexpr mode_t kOwnerOnly = 0600;

tl::unexpected<types::Error> failure(const std::filesystem::path& path, const std::string& what, int error) {
  const Errc code = error == EACCES ? Errc::kPermission : error == ENOENT ? Errc::kNotFound : Errc::kIo;
  return types::fail(code, path.string() + ": " + what + ": " + std::strerror(error), error);
}

}  // namespace

types::Result<std::unique_ptr<ControlServer>> ControlServer::listen(const std::filesystem::path& path) {
  auto socket = io::ListeningSocket::open(path.string(), kOwnerOnly);
  if (!socket.has_value()) return tl::unexpected(socket.error());
  return std::unique_ptr<ControlServer>(new ControlServer(std::move(*socket)));
}

void ControlServer::append_poll(std::vector<pollfd>& fds) const {
  fds.push_back({socket_.fd(), POLLIN, 0});
  for (const Client& client : clients_) fds.push_back({client.fd.get(), POLLIN, 0});
}

bool ControlServer::serve_client(Client& client, const Handler& handler) {
  std::array<char, 4096> buffer{};
  const auto got = ::recv(client.fd.get(), buffer.data(), buffer.size(), 0);
  if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) return false;
  if (got > 0) client.input.append(buffer.data(), static_cast<std::size_t>(got));
  if (client.input.size() > kLongestLine || client.output.size() > kLongestLine) return false;
  for (auto end = client.input.find('\n'); end != std::string::npos; end = client.input.find('\n')) {
    client.output += handler(client.input.substr(0, end)) + "\n";
    client.input.erase(0, end + 1);
  }
  if (client.output.empty()) return true;
  const auto put = ::send(client.fd.get(), client.output.data(), client.output.size(), MSG_NOSIGNAL);
  if (put > 0) client.output.erase(0, static_cast<std::size_t>(put));
  return put >= 0 || errno == EAGAIN;
}

void ControlServer::serve(const Handler& handler) {
  FileDescriptor fresh(::accept4(socket_.fd(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (fresh.valid() && clients_.size() < kMostClients) clients_.push_back({std::move(fresh), {}, {}});
  std::erase_if(clients_, [&handler](Client& client) { return !serve_client(client, handler); });
}

types::Result<std::string> ask_control(const std::filesystem::path& path, const std::string& line,
                                       int timeout_ms) {
  const auto fd = io::connect_unix(path.string());
  if (!fd.has_value()) return tl::unexpected(fd.error());
  const std::string request = line + "\n";
  if (::send(fd->get(), request.data(), request.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(request.size())) {
    return failure(path, "cannot send", errno);
  }
  std::string answer;
  std::array<char, 4096> buffer{};
  while (answer.find('\n') == std::string::npos) {
    pollfd ready{fd->get(), POLLIN, 0};
    if (::poll(&ready, 1, timeout_ms) <= 0) return failure(path, "no answer", ETIMEDOUT);
    const auto got = ::recv(fd->get(), buffer.data(), buffer.size(), 0);
    if (got <= 0) return failure(path, "the simulation went away", ECONNRESET);
    answer.append(buffer.data(), static_cast<std::size_t>(got));
  }
  answer.erase(answer.find('\n'));
  return answer;
}

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/server.hpp"

#include <fmt/format.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace topo::daemon {
namespace {

constexpr std::size_t kMaxClients = 32;
constexpr std::size_t kMaxUnread = 1 << 20;

}  // namespace

struct ControlServer::Client {
  ControlServer* server = nullptr;
  std::uint64_t number = 0;
  bool may_command = false;
  bool dead = false;
  bool subscribed = false;
  io::UniqueFd fd;
  EventSource source;
  LineBuffer in{kMaxRequestBytes};
  std::string out;
};

ControlServer::ControlServer(sd_event* event, io::ListeningSocket socket, std::optional<gid_t> group,
                             Handler handler)
    : event_(event), socket_(std::move(socket)), group_(group), handler_(std::move(handler)) {}

ControlServer::~ControlServer() = default;

types::Status ControlServer::start() {
  sd_event_source* source = nullptr;
  const int added = sd_event_add_io(event_, &source, socket_.fd(), EPOLLIN, &ControlServer::on_connect, this);
  if (added < 0)
    return types::fail(types::Errc::kIo, fmt::format("control socket: {}", std::strerror(-added)), -added);
  source_.reset(source);
  return {};
}

int ControlServer::on_connect(sd_event_source*, int fd, std::uint32_t, void* server) {
  static_cast<ControlServer*>(server)->accept_one(fd);
  return 0;
}

int ControlServer::on_client(sd_event_source*, int, std::uint32_t events, void* data) {
  auto& client = *static_cast<Client*>(data);
  ControlServer& server = *client.server;
  bool alive = (events & EPOLLERR) == 0;
  if (alive && (events & EPOLLOUT) != 0) alive = server.write_to(client);
  if (alive && (events & (EPOLLIN | EPOLLHUP)) != 0) alive = server.read_from(client);
  if (!alive || client.dead) server.drop(client);
  return 0;
}

void ControlServer::accept_one(int listening) {
  io::UniqueFd fd(::accept4(listening, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!fd.valid()) return;  // the client has left, or no descriptor is free: it may try again
  const auto peer = peer_of(fd.get());
  if (!peer) return;
  // Any user may e-stop, so that every client must be accepted: the oldest one is dropped.
  if (clients_.size() >= kMaxClients) clients_.pop_front();
  Client& client = clients_.emplace_back();
  client.server = this;
  client.number = next_client_++;
  client.may_command = topo::daemon::may_command(*peer, ::geteuid(), group_);
  client.fd = std::move(fd);
  sd_event_source* source = nullptr;
  if (sd_event_add_io(event_, &source, client.fd.get(), EPOLLIN, &ControlServer::on_client, &client) < 0) {
    clients_.pop_back();
    return;
  }
  client.source.reset(source);
}

bool ControlServer::read_from(Client& client) {
  std::array<char, 4096> bytes{};
  const ssize_t got = ::recv(client.fd.get(), bytes.data(), bytes.size(), 0);
  if (got == 0) return false;
  if (got < 0) return errno == EAGAIN || errno == EINTR;
  const bool fits = client.in.append({bytes.data(), static_cast<std::size_t>(got)});
  while (const auto line = client.in.take_line()) {
    if (!line->empty()) serve_line(client, *line);
  }
  if (fits) return true;
  send(client, error_line(nullptr, {RpcCode::kInvalidRequest,
                                    fmt::format("request of more than {} bytes", kMaxRequestBytes)}));
  return false;
}

void ControlServer::serve_line(Client& client, const std::string& line) {
  auto request = parse_request(line);
  if (!request) {
    send(client, error_line(nullptr, request.error()));
    return;
  }
  const Call call{client.number, client.may_command, std::move(*request)};
  const auto given = handler_(call);
  if (given) answer(call, *given);
}

void ControlServer::answer(const Call& call, const Answer& answer) {
  if (call.request.notify) return;
  const auto client = std::find_if(clients_.begin(), clients_.end(),
                                   [&call](const Client& c) { return c.number == call.client; });
  if (client == clients_.end()) return;
  send(*client, answer ? result_line(call.request.id, *answer) : error_line(call.request.id, answer.error()));
}

void ControlServer::subscribe(std::uint64_t number) {
  for (Client& client : clients_) client.subscribed = client.subscribed || client.number == number;
}

void ControlServer::publish(const Json& params) {
  const std::string line = notification_line("event", params);
  for (Client& client : clients_) {
    if (client.subscribed && !client.dead) send(client, line);
  }
}

void ControlServer::send(Client& client, const std::string& line) {
  client.out += line;
  if (!write_to(client) || client.out.size() > kMaxUnread) client.dead = true;
  if (!client.dead) return;
  // The client is dropped in its own event, which the shut-down socket raises at once: the caller still uses
  // it.
  ::shutdown(client.fd.get(), SHUT_RDWR);
}

bool ControlServer::write_to(Client& client) {
  while (!client.out.empty()) {
    const ssize_t sent = ::send(client.fd.get(), client.out.data(), client.out.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0 && errno != EAGAIN) return false;
    if (sent < 0) break;
    client.out.erase(0, static_cast<std::size_t>(sent));
  }
  const std::uint32_t events = client.out.empty() ? EPOLLIN : EPOLLIN | EPOLLOUT;
  return sd_event_source_set_io_events(client.source.get(), events) >= 0;
}

void ControlServer::drop(const Client& client) {
  clients_.remove_if([&client](const Client& c) { return &c == &client; });
}

}  // namespace topo::daemon

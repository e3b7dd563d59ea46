// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/server.hpp"

#include <fmt/format.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <vector>

#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

constexpr std::size_t kMaxUnread = 1 << 20;
// Of one client: a script that sends all its requests at once has fewer. Beyond, the kernel's buffer fills
// and the client waits.
constexpr std::size_t kMaxWaiting = 64;
// Before one turn: the kernel holds no more (io::ListeningSocket). Those beyond their quota take some
// microseconds.
constexpr int kMaxAccepted = 512;
constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

std::uint64_t to_usec(types::Stamp stamp) {
  const auto usec = std::chrono::ceil<std::chrono::microseconds>(stamp.time_since_epoch()).count();
  return static_cast<std::uint64_t>(std::max<std::int64_t>(usec, 0));
}

/// True when something has come on the connection, and no e-stop is in it.
bool only_asks(int fd) {
  std::array<char, 4096> bytes{};
  const ssize_t got = ::recv(fd, bytes.data(), bytes.size(), MSG_PEEK);
  return got > 0 && !may_hold_estop({bytes.data(), static_cast<std::size_t>(got)});
}

}  // namespace

struct ControlServer::Client {
  ControlServer* server = nullptr;
  std::uint64_t number = 0;
  Standing standing;
  bool dead = false;
  bool ended = false;  ///< it sends nothing any more, and still reads
  bool subscribed = false;
  int unanswered = 0;  ///< calls whose answer comes later
  io::UniqueFd fd;
  EventSource source;
  LineBuffer in{kMaxRequestBytes};
  std::string out;
};

ControlServer::ControlServer(sd_event* event, io::ListeningSocket socket, ControlRules rules, Handler handler)
    : event_(event),
      socket_(std::move(socket)),
      rules_(std::move(rules)),
      handler_(std::move(handler)),
      turns_(rules_.quota),
      connections_(rules_.quota.connection_period, rules_.quota.connection_burst) {}

ControlServer::~ControlServer() = default;

types::Status ControlServer::start() {
  sd_event_source* source = nullptr;
  int added = sd_event_add_io(event_, &source, socket_.fd(), EPOLLIN, &ControlServer::on_connect, this);
  if (added >= 0) {
    source_.reset(source);
    // A timer, not a deferred source: the loop serves sources in the order in which they became due, and a
    // deferred source stays due, so that it would keep all others out.
    constexpr std::uint64_t kAccuracyUsec = 1000;
    added =
        sd_event_add_time(event_, &source, CLOCK_MONOTONIC, 0, kAccuracyUsec, &ControlServer::on_turn, this);
  }
  if (added < 0)
    return types::fail(types::Errc::kIo, fmt::format("control socket: {}", std::strerror(-added)), -added);
  next_turn_.reset(source);
  return {};
}

int ControlServer::on_connect(sd_event_source*, int, std::uint32_t, void* server) {
  static_cast<ControlServer*>(server)->take_turn();
  return 0;
}

int ControlServer::on_client(sd_event_source*, int, std::uint32_t events, void* data) {
  auto& client = *static_cast<Client*>(data);
  ControlServer& server = *client.server;
  bool alive = (events & EPOLLERR) == 0 && !client.dead;
  if (alive && (events & EPOLLOUT) != 0) alive = server.write_to(client);
  if ((events & EPOLLHUP) != 0) {
    server.hear_out(client);
    alive = false;
  }
  if (!alive) server.drop(client.number);
  server.take_turn();
  return 0;
}

int ControlServer::on_turn(sd_event_source*, std::uint64_t, void* server) {
  static_cast<ControlServer*>(server)->take_turn();
  return 0;
}

void ControlServer::take_turn() {
  for (int accepted = 0; accepted < kMaxAccepted && accept_one();) ++accepted;
  read_from_all();
  if (const auto turn = turns_.next(io::monotonic_now())) {
    serve(*turn);
    drop_when_through(turn->client);
  }
  schedule();
}

/// The next turn comes through the loop, so that its other sources are served between two requests.
void ControlServer::schedule() {
  const auto at = turns_.next_at(io::monotonic_now());
  if (at) sd_event_source_set_time(next_turn_.get(), to_usec(*at));
  sd_event_source_set_enabled(next_turn_.get(), at ? SD_EVENT_ONESHOT : SD_EVENT_OFF);
}

void ControlServer::serve(const Turns::Turn& turn) {
  auto parsed = parse_request(turn.line);
  if (!parsed) {
    turns_.answered(turn.standing.may_command);
    return send(turn.client, error_line(nullptr, parsed.error()));
  }
  RpcRequest& request = *parsed;
  if (const std::string* text = cache_.find(request, io::monotonic_now())) {
    turns_.answered(turn.standing.may_command);
    if (!request.notify) send(turn.client, prepared_line(request.id, *text));
    return;
  }
  if (Client* client = find(turn.client)) ++client->unanswered;
  const Call call{turn.client, turn.standing.may_command, std::move(request), turn.overtaken};
  if (const auto given = handler_(call)) answer(call, *given);
}

void ControlServer::answer(const Call& call, const Answer& answer) {
  turns_.answered(call.may_command);
  if (Client* client = find(call.client)) --client->unanswered;
  const Json& id = call.request.id;
  std::string line;
  if (answer) {
    const std::string text = result_text(*answer);
    cache_.keep(call.request, text, io::monotonic_now());
    line = prepared_line(id, text);
  } else {
    line = error_line(id, answer.error());
  }
  if (!call.request.notify) send(call.client, line);
  drop_when_through(call.client);
  schedule();  // one who may not command may have waited for this
}

/// False when there is nobody to be accepted.
bool ControlServer::accept_one() {
  io::UniqueFd fd(::accept4(socket_.fd(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!fd.valid()) return false;  // the client has left, or no descriptor is free: it may try again
  const auto peer = peer_of(fd.get());
  if (!peer) return true;
  take_in(std::move(fd), {rules_.may_command(*peer), peer->uid});
  return true;
}

void ControlServer::take_in(io::UniqueFd fd, const Standing& standing) {
  const bool within_quota = standing.may_command || connections_.take(standing.user, io::monotonic_now());
  if (!within_quota && only_asks(fd.get())) return;
  make_room(standing);
  Client& client = clients_.emplace_back();
  client.server = this;
  client.number = next_client_++;
  client.standing = standing;
  client.fd = std::move(fd);
  turns_.join(client.number, standing);
  sd_event_source* source = nullptr;
  if (sd_event_add_io(event_, &source, client.fd.get(), EPOLLIN, &ControlServer::on_client, &client) < 0) {
    return drop(client.number);
  }
  client.source.reset(source);
}

void ControlServer::make_room(const Standing& newcomer) {
  std::vector<Standing> present;
  for (const Client& client : clients_) present.push_back(client.standing);
  const auto leaves = who_leaves(present, newcomer, rules_.seats);
  if (!leaves) return;
  Client& client = *std::next(clients_.begin(), static_cast<std::ptrdiff_t>(*leaves));
  hear_out(client);  // an e-stop that has come is done, though nobody is answered
  drop(client.number);
}

void ControlServer::read_from_all() {
  for (auto next = clients_.begin(); next != clients_.end();) {
    Client& client = *next++;
    const bool alive = read_from(client);
    if (!alive || is_through(client) || !watch(client)) drop(client.number);
  }
}

/// Takes in what has come, as far as there is room. False when the client has to leave.
bool ControlServer::read_from(Client& client) {
  if (client.dead) return false;
  take_lines(client, kMaxWaiting);
  if (client.ended || turns_.waiting(client.number) >= kMaxWaiting) return true;
  std::array<char, 4096> bytes{};
  const ssize_t got = ::recv(client.fd.get(), bytes.data(), bytes.size(), 0);
  client.ended = got == 0;
  if (got == 0) return true;
  if (got < 0) return errno == EAGAIN || errno == EINTR;
  const bool fits = client.in.append({bytes.data(), static_cast<std::size_t>(got)});
  take_lines(client, kMaxWaiting);
  if (fits) return true;
  send(client, error_line(nullptr, {RpcCode::kInvalidRequest,
                                    fmt::format("request of more than {} bytes", kMaxRequestBytes)}));
  return false;
}

void ControlServer::take_lines(Client& client, std::size_t room) {
  for (std::size_t waiting = turns_.waiting(client.number); waiting < room; ++waiting) {
    auto line = client.in.take_line();
    if (!line) return;
    const bool estop = is_estop(*line);
    if (!line->empty()) turns_.add(client.number, std::move(*line), estop);
  }
}

/// The client is about to be dropped: takes in the rest that it sent, at most what the kernel's buffer holds.
void ControlServer::hear_out(Client& client) {
  constexpr int kMostPieces = 64;  // 256 KiB; the kernel's buffer holds 208 KiB (net.core.wmem_default)
  std::array<char, 4096> bytes{};
  for (int piece = 0; piece < kMostPieces; ++piece) {
    take_lines(client, kNoLimit);
    const ssize_t got = ::recv(client.fd.get(), bytes.data(), bytes.size(), 0);
    if (got <= 0 || !client.in.append({bytes.data(), static_cast<std::size_t>(got)})) return;
  }
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

/// Null when it has left.
ControlServer::Client* ControlServer::find(std::uint64_t number) {
  const auto client = std::find_if(clients_.begin(), clients_.end(),
                                   [number](const Client& c) { return c.number == number; });
  return client == clients_.end() ? nullptr : &*client;
}

void ControlServer::send(std::uint64_t number, const std::string& line) {
  if (Client* client = find(number)) send(*client, line);
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
  return watch(client);
}

/// Asks the loop for the events that the client is ready for.
bool ControlServer::watch(Client& client) {
  const bool reads = !client.ended && turns_.waiting(client.number) < kMaxWaiting;
  const std::uint32_t events = (reads ? EPOLLIN : 0U) | (client.out.empty() ? 0U : EPOLLOUT);
  return sd_event_source_set_io_events(client.source.get(), events) >= 0;
}

/// One that sends nothing any more leaves when it has been answered.
bool ControlServer::is_through(const Client& client) const {
  return client.ended && client.out.empty() && client.unanswered == 0 && turns_.waiting(client.number) == 0;
}

void ControlServer::drop_when_through(std::uint64_t number) {
  if (const Client* client = find(number); client != nullptr && is_through(*client)) drop(number);
}

void ControlServer::drop(std::uint64_t number) {
  turns_.leave(number);
  clients_.remove_if([number](const Client& c) { return c.number == number; });
}

}  // namespace topo::daemon

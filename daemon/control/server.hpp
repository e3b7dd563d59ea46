// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <systemd/sd-event.h>

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>

#include "daemon/control/answer_cache.hpp"
#include "daemon/control/credentials.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/control/line_buffer.hpp"
#include "daemon/control/seats.hpp"
#include "daemon/control/turns.hpp"
#include "drivers/io/unix_socket.hpp"

namespace topo::daemon {

/// Result of a method.
using Answer = tl::expected<Json, RpcError>;

/// One request of one client.
struct Call {
  std::uint64_t client = 0;
  bool may_command = false;
  RpcRequest request;
  bool overtaken = false;  ///< an e-stop was served while this waited
};

struct EventSourceDeleter {
  void operator()(sd_event_source* source) const { sd_event_source_disable_unref(source); }
};
using EventSource = std::unique_ptr<sd_event_source, EventSourceDeleter>;

/// Who may command, and how much the others may ask.
struct ControlRules {
  std::function<bool(const Peer&)> may_command;
  Quota quota;
  Seats seats;
};

/// Serves JSON-RPC to several clients on the thread of one sd_event loop, one request a turn in the order of
/// Turns; before each turn it accepts and reads what has come, so that an e-stop waits for the request that
/// is being served and for one more at most, whatever others send. Between two turns the loop serves its
/// other sources. Never waits for a client: unread output is kept up to a limit, beyond which the client is
/// dropped; a client with many requests waiting is not read from.
class ControlServer {
 public:
  /// Returns nothing when the answer comes later through answer(), which must be called once for every call.
  using Handler = std::function<std::optional<Answer>(const Call&)>;

  /// `socket` is listening; `event` must outlive the server.
  ControlServer(sd_event* event, io::ListeningSocket socket, ControlRules rules, Handler handler);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  /// kIo when the loop cannot add the socket.
  types::Status start();

  /// Sends the late answer to a call; ignored when the client has left.
  void answer(const Call& call, const Answer& answer);

  /// From now on the client receives published events.
  void subscribe(std::uint64_t client);
  /// Sends a notification to all subscribers: {"jsonrpc": "2.0", "method": "event", "params": {...}}.
  void publish(const Json& params);

  [[nodiscard]] std::size_t clients() const { return clients_.size(); }

 private:
  struct Client;
  static int on_connect(sd_event_source* source, int fd, std::uint32_t events, void* server);
  static int on_client(sd_event_source* source, int fd, std::uint32_t events, void* client);
  static int on_turn(sd_event_source* source, std::uint64_t usec, void* server);
  void take_turn();
  void schedule();
  void serve(const Turns::Turn& turn);
  bool accept_one();
  void take_in(io::UniqueFd fd, const Standing& standing);
  void make_room(const Standing& newcomer);
  void read_from_all();
  bool read_from(Client& client);
  void take_lines(Client& client, std::size_t room);
  void hear_out(Client& client);
  bool write_to(Client& client);
  bool watch(Client& client);
  Client* find(std::uint64_t client);
  void send(std::uint64_t client, const std::string& line);
  void send(Client& client, const std::string& line);
  void drop(std::uint64_t client);
  [[nodiscard]] bool is_through(const Client& client) const;
  void drop_when_through(std::uint64_t client);

  sd_event* event_;
  io::ListeningSocket socket_;
  ControlRules rules_;
  Handler handler_;
  Turns turns_;
  UserQuota connections_;  ///< of users who may not command
  AnswerCache cache_;
  EventSource source_, next_turn_;
  std::list<Client> clients_;  ///< oldest first; addresses stay
  std::uint64_t next_client_ = 1;
};

}  // namespace topo::daemon

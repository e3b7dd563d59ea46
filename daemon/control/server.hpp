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

#include "daemon/control/credentials.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/control/line_buffer.hpp"
#include "drivers/io/unix_socket.hpp"

namespace topo::daemon {

/// Result of a method.
using Answer = tl::expected<Json, RpcError>;

/// One request of one client.
struct Call {
  std::uint64_t client = 0;
  bool may_command = false;
  RpcRequest request;
};

struct EventSourceDeleter {
  void operator()(sd_event_source* source) const { sd_event_source_disable_unref(source); }
};
using EventSource = std::unique_ptr<sd_event_source, EventSourceDeleter>;

/// Serves JSON-RPC to several clients on the thread of one sd_event loop. Never waits for a client: unread
/// output is kept up to a limit, beyond which the client is dropped.
class ControlServer {
 public:
  /// Returns nothing when the answer comes later through answer().
  using Handler = std::function<std::optional<Answer>(const Call&)>;

  /// `socket` is listening; `event` must outlive the server.
  ControlServer(sd_event* event, io::ListeningSocket socket, std::optional<gid_t> group, Handler handler);
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
  void accept_one(int fd);
  bool read_from(Client& client);
  void serve_line(Client& client, const std::string& line);
  bool write_to(Client& client);
  void send(Client& client, const std::string& line);
  void drop(const Client& client);

  sd_event* event_;
  io::ListeningSocket socket_;
  std::optional<gid_t> group_;
  Handler handler_;
  EventSource source_;
  std::list<Client> clients_;  ///< oldest first; addresses stay
  std::uint64_t next_client_ = 1;
};

}  // namespace topo::daemon

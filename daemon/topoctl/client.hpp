// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "core/types/stamp.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/control/line_buffer.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {

/// One connection to a daemon's control socket. Blocking; used by one thread.
class Client {
 public:
  /// kNotFound: no daemon serves the socket. kTimeout: it did not accept the connection.
  static types::Result<Client> connect(const std::string& socket,
                                       types::Duration patience = std::chrono::seconds(5));

  /// Sends a request and waits for the answer. kTimeout, kClosed, or as parse_answer(). Notifications
  /// received meanwhile are kept for next_event().
  types::Result<Json> call(std::string_view method, const Json& params, types::Duration timeout);

  /// The params of the next notification, after "events.subscribe" was called. kTimeout, kClosed.
  types::Result<Json> next_event(types::Duration timeout);

  /// For a poll loop; input that was already read does not show.
  [[nodiscard]] int fd() const { return fd_.get(); }

 private:
  explicit Client(io::UniqueFd fd) : fd_(std::move(fd)) {}
  types::Result<std::string> read_line(types::Stamp deadline);

  // An answer may be long, but a daemon that never ends a line is faulty.
  static constexpr std::size_t kMaxAnswerBytes = 4 << 20;
  io::UniqueFd fd_;
  LineBuffer in_{kMaxAnswerBytes};
  std::deque<Json> events_;
  int next_id_ = 1;
};

}  // namespace topo::daemon

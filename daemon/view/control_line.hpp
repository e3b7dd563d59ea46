// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <map>
#include <string>

#include "core/types/stamp.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/control/line_buffer.hpp"

namespace topo::daemon {

/// A connection to the daemon's control socket that waits for nothing: calls are answered by functions. It
/// connects again, once a second, for as long as it lives, and gives up a connection on which an answer is
/// 20 s overdue. One thread.
class ControlLine {
 public:
  using Done = std::function<void(const types::Result<Json>&)>;
  struct News {
    std::function<void()> joined;
    std::function<void(const std::string& why)> lost;
    std::function<void(const Json& params)> event;
  };
  ControlLine(boost::asio::io_context& io, std::string socket, News news);

  /// Connects, now and whenever the connection is lost.
  void start();
  [[nodiscard]] bool joined() const { return joined_; }
  /// Calls a method; `done` gets the answer as parse_answer() gives it, or kClosed: at once without a daemon,
  /// otherwise when the connection is lost before the answer.
  void call(std::string_view method, const Json& params, Done done);

 private:
  struct Waiting {
    Done done;
    types::Stamp since{};
  };
  void connect();
  void read();
  void take_line(const std::string& line);
  void write();
  void watch();
  void lose(const std::string& why);

  boost::asio::local::stream_protocol::socket peer_;
  boost::asio::steady_timer again_, watch_;
  std::string socket_;
  News news_;
  bool joined_ = false, writing_ = false;
  std::uint64_t connection_ = 0;  ///< counts them: what belongs to a former one is not heard any more
  LineBuffer in_;
  std::array<char, 16384> bytes_{};
  std::string out_, sending_;
  std::map<int, Waiting> waiting_;
  int next_id_ = 1;
};

}  // namespace topo::daemon

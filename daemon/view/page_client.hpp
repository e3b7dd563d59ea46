// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <memory>
#include <string>

#include "daemon/control/token_bucket.hpp"
#include "daemon/view/outbox.hpp"
#include "daemon/view/view_parts.hpp"

namespace topo::daemon {

/// An open page: what it is sent, by its outbox, and what it may want. One message is being sent at a time,
/// and the next is chosen when that has gone: a page that does not read costs its outbox and one message, and
/// is dropped when it has answered nothing for 20 s. Lives while an operation of its is pending.
class PageClient : public std::enable_shared_from_this<PageClient> {
 public:
  using Request = boost::beast::http::request<boost::beast::http::string_body>;
  /// `seat` is given back with the client.
  PageClient(boost::beast::tcp_stream stream, ViewParts& parts, std::shared_ptr<void> seat);

  /// Answers the request for a WebSocket, then serves.
  void start(const Request& request);
  /// Sends what is new on the board, when nothing is being sent.
  void pump();
  /// True while the page is open and may look.
  [[nodiscard]] bool is_watching() const { return open_ && outbox_.shown(); }

 private:
  void read();
  void take(std::string_view text);
  [[nodiscard]] types::Result<Json> play(const Act& act, bool within);
  void authorise(const Act& act);
  void greet();
  void answer(std::uint64_t id, const types::Result<Json>& result);
  void drop();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  ViewParts& parts_;
  std::shared_ptr<void> seat_;
  boost::beast::flat_buffer in_;
  Outbox outbox_;
  TokenBucket acts_;
  std::string token_hash_;  ///< that the page has proven; empty: none
  int wrong_tokens_ = 0;
  Text sending_;  ///< null: nothing is being sent
  bool open_ = false;
};

}  // namespace topo::daemon

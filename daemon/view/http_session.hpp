// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <functional>
#include <memory>
#include <optional>

#include "daemon/view/view_parts.hpp"

namespace topo::daemon {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// True when the request may be answered at all: by Host and Origin (request_check.hpp).
bool is_permitted(const HttpRequest& request, const std::vector<std::string>& hosts);

/// The answer to a request that is not for a WebSocket: a file of the page, 403 for a foreign Host or Origin,
/// 404, 405. Every answer forbids what the page does not need: scripts and styles that are not its files,
/// other origins, frames.
HttpResponse answer_request(const HttpRequest& request, const std::vector<std::string>& hosts);

/// One connection until it is a page, or closed; 10 s for each request.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  /// Takes a connection whose request is for a WebSocket. False: there are pages enough.
  using TakePage = std::function<bool(boost::beast::tcp_stream&& stream, const HttpRequest& request,
                                      const std::shared_ptr<void>& seat)>;
  HttpSession(boost::beast::tcp_stream stream, ViewParts& parts, std::shared_ptr<void> seat,
              TakePage take_page)
      : stream_(std::move(stream)), parts_(parts), seat_(std::move(seat)), take_page_(std::move(take_page)) {}

  void start() { read(); }

 private:
  void read();
  void serve(const HttpRequest& request);
  void send(HttpResponse response);

  boost::beast::tcp_stream stream_;
  ViewParts& parts_;
  std::shared_ptr<void> seat_;
  TakePage take_page_;
  boost::beast::flat_buffer in_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  std::optional<HttpResponse> response_;
};

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "daemon/view/http_session.hpp"
#include "daemon/view/page_client.hpp"
#include "daemon/view/view_parts.hpp"

namespace topo::daemon {

/// Listens, and knows the open pages. One thread.
class ViewServer {
 public:
  ViewServer(boost::asio::io_context& io, ViewParts& parts);

  /// kInvalidInput for no IP address; kIo when the port cannot be had. Port 0: any, see port().
  types::Status listen(const std::string& address, int port);
  [[nodiscard]] int port() const;

  /// To be called when something is new on the board.
  void tell_pages();
  /// True while a page is open that may look.
  [[nodiscard]] bool is_watched() const;

 private:
  void accept();
  void take_in(boost::asio::ip::tcp::socket socket);
  [[nodiscard]] std::shared_ptr<void> seat_for(const boost::asio::ip::tcp::socket& socket);
  bool take_page(boost::beast::tcp_stream&& stream, const HttpRequest& request,
                 const std::shared_ptr<void>& seat);

  ViewParts& parts_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer again_;
  /// Connections of each address; shared with the seats, which may outlive the server.
  std::shared_ptr<std::map<std::string, std::size_t>> seats_;
  std::vector<std::weak_ptr<PageClient>> pages_;
};

}  // namespace topo::daemon

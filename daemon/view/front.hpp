// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <string>
#include <utility>

#include "core/types/result.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/view/board_rules.hpp"
#include "daemon/view/view_server.hpp"

namespace topo::daemon {

/// What serves pages, whatever feeds the board: a daemon, or a replay. One thread.
class Front {
 public:
  /// `name`: what pages are of. `call`: what becomes of orders.
  Front(const Configuration& configuration, const std::string& name, OrderDesk::Call call);

  [[nodiscard]] boost::asio::io_context& io() { return io_; }
  [[nodiscard]] Board& board() { return board_; }
  /// From now on pages are of a replay.
  void set_time_line(TimeLineWish wish) { parts_.time_line = std::move(wish); }
  [[nodiscard]] BoardRules rules();

  /// kIo or kInvalidInput when it cannot listen.
  types::Status listen(const ViewConfig& view);
  /// Until SIGTERM, SIGINT or SIGHUP; tells the service manager that it is ready, and that it lives.
  void run();

 private:
  void tell_alive();

  // Pages live in pending operations, and those in the context: it goes last.
  boost::asio::io_context io_{1};
  Board board_;
  OrderDesk orders_;
  Rights rights_;
  ViewParts parts_;
  ViewServer server_;
  boost::asio::signal_set ending_;
  boost::asio::steady_timer alive_;
};

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <string>

#include "core/types/stamp.hpp"
#include "daemon/view/board.hpp"
#include "daemon/view/board_rules.hpp"
#include "daemon/view/replay/map_film.hpp"
#include "daemon/view/replay/open.hpp"
#include "daemon/view/replay/time_line.hpp"

namespace topo::daemon {

/// Feeds the board from a session, as Feed does from a daemon: five times a second what was at the position
/// of the time line. All pages see the same; it stands while nobody looks. One thread.
class Player {
 public:
  struct Params {
    std::string robot;
    slam::GridParams grid;
  };
  Player(boost::asio::io_context& io, const Params& params, Board& board, BoardRules rules);

  /// `is_growing`: there will be more of it.
  void load(Played played, bool is_growing);
  void start() { tick(); }
  /// As TimeLine::take(); it is shown at once.
  types::Status take(const Json& wish);

 private:
  void tick();
  void show();
  void show_map(double t_s);

  std::string robot_;
  Board& board_;
  BoardRules rules_;
  boost::asio::steady_timer tick_;
  Played played_;
  bool is_growing_ = false;
  TimeLine line_;
  MapFilm film_;
  std::uint64_t revision_ = 0;  ///< of the map that is on the board
  types::Stamp last_{};
};

}  // namespace topo::daemon

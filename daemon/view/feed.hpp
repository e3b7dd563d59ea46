// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <string>
#include <string_view>

#include "daemon/view/board.hpp"
#include "daemon/view/board_rules.hpp"
#include "daemon/view/control_line.hpp"

namespace topo::daemon {

/// Keeps the board up to date from the daemon while somebody looks: the state five times a second, the map by
/// its changes, the rest more seldom, and the daemon's events. Of each question one is under way at a time,
/// so a slow daemon gets fewer. One thread.
class Feed {
 public:
  Feed(boost::asio::io_context& io, const std::string& socket, Board& board, BoardRules rules);

  void start();

 private:
  /// One question that is asked again and again.
  struct Question {
    std::string_view method;
    Topic topic;
    types::Duration period;
    types::Stamp due{};
    bool under_way = false;
  };
  void tick();
  void ask(Question& question, types::Stamp now);
  void ask_for_map(types::Stamp now);
  void note_place(const Json& status);
  void on_joined();
  void on_lost(const std::string& why);

  Board& board_;
  BoardRules rules_;
  ControlLine line_;
  boost::asio::steady_timer tick_;
  std::array<Question, 10> questions_;
  std::uint64_t map_revision_ = 0;
  types::Stamp map_due_{};
  bool map_under_way_ = false;
  std::string waiting_;  ///< the session that waits for the robot's place, whose map is shown; empty: none
  std::string lost_;     ///< why there is no daemon; empty while there is
};

}  // namespace topo::daemon

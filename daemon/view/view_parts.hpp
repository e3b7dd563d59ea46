// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "daemon/config/configuration.hpp"
#include "daemon/view/board.hpp"
#include "daemon/view/order_desk.hpp"
#include "daemon/view/rights.hpp"

namespace topo::daemon {

/// Bounds on what clients may take. All of them together cost some megabytes.
struct ViewLimits {
  std::size_t pages = 24;            ///< open at a time: an operator's desk, and onlookers
  std::size_t connections = 64;      ///< pages and files being loaded
  std::size_t of_one_address = 48;   ///< connections: a proxy, or a test, may bring all pages from one
  std::size_t header_bytes = 8192;   ///< of a request
  std::size_t send_buffer = 16'384;  ///< the kernel's, a page: what is in it is not the newest any more
  int acts_per_second = 10;  ///< of a page, beyond a burst of twice as many; an e-stop is always taken
  int wrong_tokens = 5;      ///< of a page, then it is dropped
};

/// What a page wants of a replay's time line.
using TimeLineWish = std::function<types::Status(const Json& wish)>;

/// What all pages share. Owned by the program, outlives the server. One thread.
struct ViewParts {
  std::string robot;  ///< its name
  ViewLook look = ViewLook::kEverybody;
  std::vector<std::string> hosts;  ///< names of this machine in a request's Host
  ViewLimits limits;
  Board& board;
  OrderDesk& orders;
  Rights& rights;
  TimeLineWish time_line{};  ///< of a replay: then no order is given; empty: the robot is live
};

}  // namespace topo::daemon

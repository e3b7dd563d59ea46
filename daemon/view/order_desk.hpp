// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "daemon/control/json_rpc.hpp"
#include "daemon/view/act.hpp"

namespace topo::daemon {

/// From pages to the daemon. Orders wait for nobody; of e-stops one is under way at a time, and those that
/// come meanwhile are said as one after it. So each is said after it came, and a flood of them from a page
/// reaches the daemon as a few. One thread.
class OrderDesk {
 public:
  using Done = std::function<void(const types::Result<Json>&)>;
  /// Calls the daemon, and `done` later or, when there is no daemon, at once.
  using Call = std::function<void(const std::string& method, const Json& params, Done done)>;
  static constexpr std::size_t kWaitingMax = 64;  ///< e-stops whose sender waits for an answer, and orders

  explicit OrderDesk(Call call) : call_(std::move(call)) {}

  /// `act` is an e-stop or a command. Beyond kWaitingMax an e-stop is said and its sender gets kBusy; an
  /// order is not done.
  void give(const Act& act, Done done);

 private:
  void say_estop(const Act& act);
  void give_order(const Act& act, Done done);

  Call call_;
  bool estop_under_way_ = false, estop_wanted_ = false;
  std::vector<Done> said_;     ///< wait for the e-stop that is under way
  std::vector<Done> waiting_;  ///< wait for the one after it
  std::size_t orders_ = 0;     ///< under way
};

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "daemon/topoctl/commands.hpp"
#include "daemon/topoctl/tables.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

/// An order is repeated every 50 ms: who has not acknowledged it by then is out of reach.
constexpr types::Duration kOrderPatience = std::chrono::seconds(2);
constexpr types::Duration kLookAgain = std::chrono::milliseconds(50);
constexpr types::Duration kEstopPatience = std::chrono::seconds(1);

/// Robots that are alive and have not acknowledged the order.
std::vector<int> missing(const Json& team) {
  std::vector<int> robots;
  const Json& acknowledged = team.at("order").at("acknowledged");
  for (const Json& peer : team.at("peers")) {
    const int robot = peer.at("robot").get<int>();
    if (std::find(acknowledged.begin(), acknowledged.end(), robot) == acknowledged.end())
      robots.push_back(robot);
  }
  return robots;
}

types::Result<Json> wait_for_all(const Arguments& arguments, std::uint64_t order) {
  const types::Stamp limit = io::monotonic_now() + kOrderPatience;
  for (;;) {
    auto team = ask(arguments, "team");
    if (!team) return team;
    const bool told = team->at("order").at("number").get<std::uint64_t>() >= order;
    if ((told && missing(*team).empty()) || io::monotonic_now() >= limit || interrupted()) return team;
    pause_until(io::monotonic_now() + kLookAgain);
  }
}

}  // namespace

int order_team(const Arguments& arguments, const char* method) {
  const auto sent = ask(arguments, method, Json{{"all", true}}, kEstopPatience);
  if (!sent) return complain(sent.error());
  const auto order = sent->value("order", std::uint64_t{0});
  if (order == 0) {
    return complain(
        {types::Errc::kBusy, "this robot obeys, but its daemon has no team, or takes no more orders now", 0});
  }
  const auto team = wait_for_all(arguments, order);
  if (!team) return complain(team.error());
  const std::vector<int> late = missing(*team);
  if (arguments.json) {
    fmt::print("{}\n",
               one_line(Json{{"acknowledged", team->at("order").at("acknowledged")}, {"not_reached", late}}));
  } else {
    fmt::print("this robot obeys\n");
    for (const Json& robot : team->at("order").at("acknowledged"))
      fmt::print("robot {} has acknowledged\n", robot.get<int>());
    for (const int robot : late) fmt::print("robot {} was NOT reached: stop it by hand\n", robot);
  }
  return late.empty() ? kOk : kFailed;
}

}  // namespace topo::daemon

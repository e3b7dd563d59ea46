// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "daemon/topoctl/commands.hpp"
#include "daemon/topoctl/tables.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

/// An order is repeated every 50 ms: who has not acknowledged it by then is out of reach.
constexpr types::Duration kOrderPatience = std::chrono::seconds(2);
constexpr types::Duration kAskAgain = std::chrono::milliseconds(50);

bool has_word(const Json& order, int robot) {
  const Json& acknowledged = order.at("acknowledged");
  if (std::find(acknowledged.begin(), acknowledged.end(), robot) != acknowledged.end()) return true;
  const Json& refused = order.at("refused");
  return std::any_of(refused.begin(), refused.end(),
                     [&](const Json& one) { return one.at("robot").get<int>() == robot; });
}

/// Robots that the order is for and that have not said their word: that one, whether it is still heard or
/// not, or all that are in sight.
std::vector<int> missing(const Json& team) {
  const Json& order = team.at("order");
  std::vector<int> robots;
  if (order.at("to").is_null())
    for (const Json& peer : team.at("peers")) robots.push_back(peer.at("robot").get<int>());
  else
    robots.push_back(order.at("to").get<int>());
  std::erase_if(robots, [&](int robot) { return has_word(order, robot); });
  return robots;
}

void print_words(const Json& team, const std::vector<int>& late, const char* method) {
  for (const Json& robot : team.at("order").at("acknowledged"))
    fmt::print("robot {} has acknowledged\n", robot.get<int>());
  for (const Json& one : team.at("order").at("refused"))
    fmt::print("robot {} refuses: {}\n", one.at("robot").get<int>(), one.at("why").get<std::string>());
  const std::string_view act = method;
  const char* cure = act == "estop" || act == "stop" ? ": stop it by hand" : "";
  for (const int robot : late) fmt::print("robot {} was NOT reached{}\n", robot, cure);
}

types::Result<Json> wait_for_all(const Arguments& arguments, std::uint64_t order) {
  const types::Stamp limit = io::monotonic_now() + kOrderPatience;
  for (;;) {
    auto team = ask(arguments, "team");
    if (!team) return team;
    const bool told = team->at("order").at("number").get<std::uint64_t>() >= order;
    if ((told && missing(*team).empty()) || io::monotonic_now() >= limit || interrupted()) return team;
    pause_until(io::monotonic_now() + kAskAgain);
  }
}

}  // namespace

int order_team(const Arguments& arguments, const char* method) {
  const Json whom = arguments.whom.robot > 0 ? Json{{"robot", arguments.whom.robot}} : Json{{"all", true}};
  const auto sent = ask(arguments, method, whom, kEstopPatience);
  if (!sent) return complain(sent.error());
  if (arguments.whom.robot > 0 && !sent->contains("order")) return kOk;  // it is this one
  const auto order = sent->value("order", std::uint64_t{0});
  const std::string here = sent->value("refused_here", "");
  if (order == 0) {
    return complain({types::Errc::kBusy,
                     (here.empty() ? "this robot obeys" : "this robot refuses: " + here) +
                         ", but its daemon has no team, or takes no more orders now",
                     0});
  }
  const auto team = wait_for_all(arguments, order);
  if (!team) return complain(team.error());
  const std::vector<int> late = missing(*team);
  const Json& said = team->at("order");
  if (arguments.json) {
    fmt::print("{}\n", one_line(Json{{"acknowledged", said.at("acknowledged")},
                                     {"refused", said.at("refused")},
                                     {"refused_here", here},
                                     {"not_reached", late}}));
  } else {
    if (arguments.whom.robot == 0)
      fmt::print("{}\n", here.empty() ? "this robot obeys" : "this robot refuses: " + here);
    print_words(*team, late, method);
  }
  return late.empty() && said.at("refused").empty() && here.empty() ? kOk : kFailed;
}

int order(const Arguments& arguments, const char* method) {
  if (arguments.whom.all || arguments.whom.robot > 0) return order_team(arguments, method);
  return show(arguments, method, [](const Json&) { return std::string(); });
}

}  // namespace topo::daemon

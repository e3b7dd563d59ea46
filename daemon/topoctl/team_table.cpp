// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "daemon/topoctl/tables.hpp"

namespace topo::daemon {
namespace {

std::string milliseconds(const Json& seconds) {
  return seconds.is_number() ? fmt::format("{:.0f} ms", 1e3 * seconds.get<double>()) : "-";
}
std::string percent(const Json& share) {
  return share.is_number() ? fmt::format("{:.0f} %", 100.0 * share.get<double>()) : "-";
}
std::string kilobytes(const Json& lack) {
  return lack.is_object() ? fmt::format("{:.1f} kB", lack.value("bytes", 0.0) / 1e3) : "-";
}
std::string claim(const Json& peer) {
  const Json& status = peer.value("status", Json());
  if (!status.is_object()) return "-";
  if (!status.value("claim", Json()).is_object()) return text_at(status, "/duty");
  return fmt::format("{} to {:.1f} {:.1f}", text_at(status, "/duty"), status["claim"].value("x_m", 0.0),
                     status["claim"].value("y_m", 0.0));
}

}  // namespace

std::string team_table(const Json& team) {
  if (!team.value("present", false)) return "no team: [team] is not in the configuration\n";
  std::string out = fmt::format("team        {}, this is robot {}, security {}\n", text_at(team, "/name"),
                                text_at(team, "/robot"), text_at(team, "/security"));
  out += fmt::format("link        {}\n", team["link"].value("joined", false) ? "up" : "down");
  if (const std::string trouble = text_at(team, "/trouble"); is_said(trouble))
    out += "trouble     " + trouble + "\n";
  if (const std::string warning = text_at(team, "/warning"); is_said(warning))
    out += "warning     " + warning + "\n";
  out += fmt::format("holds       {} items, {:.1f} kB\n", text_at(team, "/held/items"),
                     team["held"].value("bytes", 0.0) / 1e3);
  out += fmt::format("{:>5} {:>9} {:>10} {:>6} {:>10} {:>10} {:>8} {:>6}  {}\n", "robot", "heard",
                     "round trip", "loss", "it lacks", "lacks here", "in step", "map", "does");
  for (const Json& peer : team.value("peers", Json::array())) {
    const bool alive = peer.value("alive", false);
    out += fmt::format(
        "{:>5} {:>7.1f} s {:>10} {:>6} {:>10} {:>10} {:>8} {:>6}  {}\n", text_at(peer, "/robot"),
        peer.value("heard_s_ago", 0.0), milliseconds(peer.value("round_trip_s", Json())),
        percent(peer.value("loss_in", Json())), kilobytes(peer.value("it_lacks", Json())),
        kilobytes(peer.value("lacks_here", Json())), peer.value("in_step", false) ? "yes" : "no",
        peer.value("map_joined", false) ? "joined" : "apart", alive ? claim(peer) : "out of reach");
  }
  return out;
}

}  // namespace topo::daemon

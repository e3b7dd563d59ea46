// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/mission_log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>
#include <string_view>

namespace topo::daemon {
namespace {

constexpr types::Duration kStatePeriod = std::chrono::seconds(1);

/// The named members that are there.
template <std::size_t kCount>
Json part(const Json& all, const std::array<std::string_view, kCount>& names) {
  Json chosen = Json::object();
  for (const std::string_view name : names) {
    if (const auto at = all.find(name); at != all.end()) chosen[std::string(name)] = *at;
  }
  return chosen;
}

Json mates(const Json& team) {
  constexpr std::array<std::string_view, 9> kOfMate{"robot",        "alive",      "heard_s_ago",
                                                    "round_trip_s", "loss_in",    "loss_out",
                                                    "in_step",      "map_joined", "status"};
  Json mates = Json::array();
  if (const auto peers = team.find("peers"); peers != team.end()) {
    for (const Json& peer : *peers) mates.push_back(part(peer, kOfMate));
  }
  return mates;
}

Json doubts(const Json& status) {
  Json names = Json::array();
  const auto at = status.find("plausibility");
  if (at == status.end()) return names;
  for (const Json& doubt : (*at)["doubts"]) names.push_back(doubt["name"]);
  return names;
}

}  // namespace

void MissionLog::note_event(types::Stamp now, const Json& event) {
  Json line = event;
  line["kind"] = "event";
  add(now, std::move(line));
}

void MissionLog::note_state(types::Stamp now, const Json& status, const Json& team) {
  next_state_ = now + kStatePeriod;
  constexpr std::array<std::string_view, 12> kOfStatus{"state",    "pose",  "twist",      "commanded",
                                                       "mission",  "goal",  "activity",   "reason",
                                                       "known_m2", "estop", "open_goals", "battery_v"};
  Json line = part(status, kOfStatus);
  line["kind"] = "state";
  line["doubts"] = doubts(status);
  constexpr std::array<std::string_view, 3> kOfMap{"revision", "keyframes", "lost"};
  if (const auto map = status.find("map"); map != status.end()) line["map"] = part(*map, kOfMap);
  if (Json of_team = mates(team); !of_team.empty()) line["team"] = std::move(of_team);
  add(now, std::move(line));
}

void MissionLog::add(types::Stamp now, Json line) {
  constexpr double kPerMilli = 1e3;
  line["t_s"] = std::round(types::to_seconds(now - begin_) * kPerMilli) / kPerMilli;
  line["utc"] = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  // A device may say anything: what is not UTF-8 is replaced.
  const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (!lines_.add(text)) ++lost_;
}

}  // namespace topo::daemon

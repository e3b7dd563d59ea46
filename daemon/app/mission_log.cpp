// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/mission_log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>
#include <string_view>
#include <utility>

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
  constexpr std::array<std::string_view, 2> kOfPlace{"pose", "claim"};
  Json mates = Json::array();
  if (const auto peers = team.find("peers"); peers != team.end()) {
    for (const Json& peer : *peers) {
      Json mate = part(peer, kOfMate);
      const auto here = peer.find("here");
      if (here != peer.end() && here->is_object()) mate["here"] = part(*here, kOfPlace);
      mates.push_back(std::move(mate));
    }
  }
  return mates;
}

/// Of the team itself: this robot's order and its acknowledgements, and the link's fault.
Json in_team(const Json& team) {
  Json own = part(team, std::array<std::string_view, 1>{"robot"});
  if (const auto order = team.find("order"); order != team.end() && order->value("number", 0U) > 0)
    own["order"] = *order;
  const auto trouble = team.find("trouble");
  if (trouble != team.end() && trouble->is_string() && !trouble->get_ref<const std::string&>().empty())
    own["trouble"] = *trouble;
  return own;
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
  constexpr std::array<std::string_view, 4> kOfMap{"revision", "keyframes", "keyframes_of_all", "lost"};
  if (const auto map = status.find("map"); map != status.end()) line["map"] = part(*map, kOfMap);
  if (Json of_team = mates(team); !of_team.empty()) line["team"] = std::move(of_team);
  if (Json own = in_team(team); !own.empty()) line["in_team"] = std::move(own);
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

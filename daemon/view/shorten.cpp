// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/shorten.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

namespace topo::daemon {
namespace {

using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 17> kStatus{
    "robot",        "state",       "reason",     "activity",        "mission", "goal",
    "estop",        "estop_latch", "battery_v",  "known_m2",        "pose",    "twist",
    "plausibility", "map",         "open_goals", "free_distance_m", "session"};
constexpr std::array<std::string_view, 1> kSession{"place"};
constexpr std::array<std::string_view, 4> kPlace{"standing", "session", "waits", "proposed"};
constexpr std::array<std::string_view, 3> kMap{"revision", "keyframes", "closures"};
constexpr std::array<std::string_view, 1> kPlausibility{"doubts"};
constexpr std::array<std::string_view, 6> kGoals{"goal", "open", "given_up", "dropped", "decisions", "route"};
constexpr std::array<std::string_view, 4> kDoubt{"why", "side_m", "regions", "loose"};
constexpr std::array<std::string_view, 2> kPoint{"x_m", "y_m"};
constexpr std::array<std::string_view, 6> kTeam{"present", "name", "robot", "peers", "order", "trouble"};

void keep(Json& object, Names names) {
  if (!object.is_object()) return;
  for (auto member = object.begin(); member != object.end();)
    member = std::ranges::count(names, member.key()) > 0 ? std::next(member) : object.erase(member);
}

void keep_in(Json& object, const char* name, Names names) {
  const auto member = object.find(name);
  if (member == object.end()) return;
  if (member->is_array()) {
    for (Json& element : *member) keep(element, names);
  } else {
    keep(*member, names);
  }
}

void round_all(Json& json) {
  constexpr double kPerThousandth = 1e3;
  if (json.is_number_float()) json = std::round(json.get<double>() * kPerThousandth) / kPerThousandth;
  if (json.is_structured())
    for (Json& element : json) round_all(element);
}

/// The newest alone: it is of the goal in hand, and the log has all.
void keep_last(Json& object, const char* name) {
  const auto list = object.find(name);
  if (list != object.end() && list->is_array() && list->size() > 1) *list = Json::array({Json(list->back())});
}

}  // namespace

Json shorten(Topic topic, Json answer) {
  if (!answer.is_object()) return answer;
  if (topic == Topic::kStatus) {
    keep(answer, kStatus);
    keep_in(answer, "map", kMap);
    keep_in(answer, "plausibility", kPlausibility);
    keep_in(answer, "session", kSession);
    if (const auto session = answer.find("session"); session != answer.end())
      keep_in(*session, "place", kPlace);
  } else if (topic == Topic::kGoals) {
    keep(answer, kGoals);
    keep_in(answer, "dropped", kPoint);
    keep_last(answer, "decisions");
  } else if (topic == Topic::kDoubt) {
    keep(answer, kDoubt);
    keep_in(answer, "regions", kPoint);
    keep_in(answer, "loose", kPoint);
  } else if (topic == Topic::kTeam) {
    keep(answer, kTeam);
  }
  round_all(answer);
  return answer;
}

}  // namespace topo::daemon

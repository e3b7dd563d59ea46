// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/operator.hpp"
#include "daemon/app/plan_json.hpp"
#include "drivers/io/posix.hpp"

namespace topo::daemon {

Json Operator::status() const {
  Json json = monitor_.status();
  json["estop"] = estop_latched();
  json["mission"] = mission_json();
  const auto* report = plan_.report();
  if (report == nullptr) return json;
  json["activity"] = to_text(report->activity);
  json["reason"] = report->reason;
  json["goal"] = goal_json(report->goal);
  json["open_goals"] = report->open_goals.size();
  json["second_phase"] = report->second_phase;
  json["known_m2"] = report->known_m2;
  return json;
}

Json Operator::mission_json() const {
  return {{"number", missions_.number()},
          {"order", to_text(missions_.order())},
          {"state", to_text(missions_.state())},
          {"reason", missions_.reason()},
          {"elapsed_s", types::to_seconds(missions_.elapsed(io::monotonic_now()))},
          {"distance_m", distance_m_}};
}

Json Operator::progress() const {
  const std::string why_not = obstacle();
  return {{"ready", why_not.empty()}, {"why_not", why_not}, {"mission", mission_json()}};
}

Json Operator::goals() const {
  const auto* report = plan_.report();
  return report == nullptr ? Json::object() : goals_json(*report);
}

Json Operator::places() const {
  const auto* report = plan_.report();
  return report == nullptr ? Json::object() : places_json(*report);
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/json/plan_json.hpp"

#include <algorithm>

namespace topo::daemon {
namespace {

Json point(const types::Vector2& p) { return {{"x_m", p.x()}, {"y_m", p.y()}}; }

Json to_json(const goals::Goal& goal) {
  Json json = point(goal.p_map);
  json["opening_m"] = goal.opening_m;
  json["place"] = goal.place;
  json["side"] = goals::to_text(goal.side);
  return json;
}

}  // namespace

Json goal_json(const std::optional<goals::Goal>& goal) { return goal ? to_json(*goal) : Json(); }

Json goals_json(const pipeline::PlanningReport& report) {
  Json open = Json::array(), given_up = Json::array(), dropped = Json::array(), decisions = Json::array();
  for (const goals::Goal& goal : report.open_goals) open.push_back(to_json(goal));
  for (const exploration::DeferredGoal& goal : report.deferred) {
    Json json = point(goal.p_map);
    json["back_in_s"] = goal.is_for_good() ? Json() : Json(types::to_seconds(goal.until - report.stamp));
    json["why"] = goal.why;
    given_up.push_back(std::move(json));
  }
  if (report.analysis != nullptr) {
    for (const goals::Goal& goal : report.analysis->goals.rejected) {
      Json json = to_json(goal);
      json["why"] = goals::to_text(goal.verdict);
      dropped.push_back(std::move(json));
    }
  }
  for (const pipeline::Decision& decision : report.decisions) {
    Json json = point(decision.p_map);
    json["age_s"] = types::to_seconds(report.stamp - decision.stamp);
    json["text"] = decision.text;
    decisions.push_back(std::move(json));
  }
  return {{"goal", goal_json(report.goal)},      {"open", std::move(open)},
          {"given_up", std::move(given_up)},     {"dropped", std::move(dropped)},
          {"decisions", std::move(decisions)},   {"frontier_clusters", report.frontier_clusters},
          {"goals_issued", report.goals_issued}, {"decisions_made", report.decisions_made},
          {"clusters_sum", report.clusters_sum}, {"goals_sum", report.goals_sum},
          {"second_phase", report.second_phase}};
}

Json places_json(const pipeline::PlanningReport& report) {
  Json places = Json::array(), borders = Json::array();
  if (report.analysis == nullptr) return {{"places", places}, {"borders", borders}};
  const analysis::Analysis& analysis = *report.analysis;
  for (std::size_t i = 0; i < analysis.places.places.size(); ++i) {
    const places::Place& place = analysis.places.places[i];
    const auto goals = std::count_if(report.open_goals.begin(), report.open_goals.end(),
                                     [i](const goals::Goal& g) { return g.place == i + 1; });
    Json json = point(place.centroid);
    json["number"] = i + 1;
    json["area_m2"] = place.area_m2;
    json["length_m"] = place.box.empty() ? 0.0 : place.box.max.x() - place.box.min.x();
    json["width_m"] = place.box.empty() ? 0.0 : place.box.max.y() - place.box.min.y();
    json["goals"] = goals;
    places.push_back(std::move(json));
  }
  for (const places::PlaceBorder& border : analysis.places.borders)
    borders.push_back({{"a", border.a + 1}, {"b", border.b + 1}, {"length_m", border.length_m}});
  Json json{{"places", std::move(places)}, {"borders", std::move(borders)}};
  json["walls"] = analysis.walls.size();
  json["wings_rad"] = analysis.wings_rad;
  json["compass_rad"] = analysis.compass.angle_rad ? Json(*analysis.compass.angle_rad) : Json();
  return json;
}

}  // namespace topo::daemon

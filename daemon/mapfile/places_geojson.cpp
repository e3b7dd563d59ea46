// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/places_geojson.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "daemon/mapfile/outlines.hpp"

namespace topo::daemon {
namespace {

using Json = nlohmann::ordered_json;

/// Rounds to millimetres, which exceed the accuracy of a map.
double rounded(double v) { return std::round(v * 1000.0) / 1000.0; }

Json pair_of(const types::Vector2& p) { return Json::array({rounded(p.x()), rounded(p.y())}); }

Json feature(const char* geometry, Json coordinates, Json properties) {
  return {{"type", "Feature"},
          {"geometry", {{"type", geometry}, {"coordinates", std::move(coordinates)}}},
          {"properties", std::move(properties)}};
}

/// The features of one analysis, relative to the given origin.
class Features {
 public:
  explicit Features(const types::Vector2& origin) : origin_(origin) {}

  void add_places(const analysis::Analysis& analysis);
  void add_wall(const types::Segment& wall) {
    features_.push_back(feature("LineString", Json::array({point(wall.a), point(wall.b)}),
                                {{"kind", "wall"}, {"length_m", rounded(wall.length_m())}}));
  }
  void add_goal(const goals::Goal& goal, std::size_t number = 0);
  [[nodiscard]] Json take() { return std::move(features_); }

 private:
  [[nodiscard]] Json point(const types::Vector2& p) const { return pair_of(origin_ + p); }
  [[nodiscard]] Json closed_ring(const Ring& ring, double resolution_m) const {
    Json out = Json::array();
    for (const grid::CellIndex c : ring) out.push_back(point(types::Vector2(c.x, c.y) * resolution_m));
    out.push_back(out.front());
    return out;
  }

  [[nodiscard]] Json polygons(const std::vector<Ring>& rings, double resolution_m) const {
    Json all = Json::array();
    for (const std::vector<Ring>& part : parts_of(rings)) {
      Json polygon = Json::array();
      for (const Ring& ring : part) polygon.push_back(closed_ring(ring, resolution_m));
      all.push_back(std::move(polygon));
    }
    return all;
  }

  types::Vector2 origin_;
  Json features_ = Json::array();
};

void Features::add_places(const analysis::Analysis& analysis) {
  const places::PlaceMap& map = analysis.places;
  std::vector<Json> neighbours(map.places.size(), Json::array());
  for (const places::PlaceBorder& border : map.borders) {
    neighbours[border.a].push_back(border.b + 1);
    neighbours[border.b].push_back(border.a + 1);
  }
  const auto outlines =
      outlines_of(analysis.map, map.labels.by_cell(analysis.map.cells.size()), map.places.size());
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    const places::Place& place = map.places[p];
    Json parts = polygons(outlines[p], analysis.map.resolution_m);
    const bool is_one = parts.size() == 1;
    features_.push_back(feature(is_one ? "Polygon" : "MultiPolygon",
                                is_one ? Json(parts[0]) : std::move(parts),
                                {{"kind", "place"},
                                 {"number", p + 1},
                                 {"area_m2", rounded(place.area_m2)},
                                 {"clearance_m", rounded(static_cast<double>(place.clearance_max_m))},
                                 {"centroid", point(place.centroid)},
                                 {"neighbours", std::move(neighbours[p])}}));
  }
}

/// `number`: number among the open goals, from 1; 0: not an open goal.
void Features::add_goal(const goals::Goal& goal, std::size_t number) {
  const bool open = goal.verdict == goals::Verdict::kAccepted;
  features_.push_back(feature("Point", point(goal.p_map),
                              {{"kind", "goal"},
                               {"verdict", open ? "accepted" : std::string(goals::to_text(goal.verdict))},
                               {"place", goal.place},
                               {"side", std::string(goals::to_text(goal.side))},
                               {"opening_m", rounded(goal.opening_m)},
                               {"opening", point(goal.opening)}}));
  if (number != 0) features_.back()["properties"]["number"] = number;
}

}  // namespace

std::string places_geojson(const analysis::Analysis& analysis, std::span<const goals::Goal> open_goals,
                           const types::Vector2& origin) {
  Features features(origin);
  features.add_places(analysis);
  for (const types::Segment& wall : analysis.walls) features.add_wall(wall);
  for (std::size_t k = 0; k < open_goals.size(); ++k) features.add_goal(open_goals[k], k + 1);
  for (const goals::Goal& goal : analysis.goals.rejected) features.add_goal(goal);
  const Json collection = {{"type", "FeatureCollection"},
                           {"frame", "map"},
                           {"units", "metres"},
                           {"compass_rad", analysis.places.compass_rad},
                           {"features", features.take()}};
  return collection.dump() + "\n";
}

}  // namespace topo::daemon

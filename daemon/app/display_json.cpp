// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/display_json.hpp"

#include <cmath>
#include <span>
#include <utility>

namespace topo::daemon {
namespace {

constexpr std::size_t kMostPoints = 300;

double to_centimetres(double metres) {
  constexpr double kPerMetre = 100.0;
  return std::round(metres * kPerMetre) / kPerMetre;
}

}  // namespace

Json tiles_json(const TileBook::Part& part, double resolution_m) {
  Json tiles = Json::array();
  for (const ViewTile* tile : part.tiles) tiles.push_back(Json::array({tile->x, tile->y, tile->cells}));
  return {{"revision", part.number},
          {"more", part.more},
          {"resolution_m", resolution_m},
          {"side", TileBook::kSide},
          {"tiles", std::move(tiles)}};
}

Json trail_json(const std::vector<types::Vector2>& places_map) {
  const std::size_t step = places_map.size() / kMostPoints + 1;
  Json trail = Json::array();
  for (std::size_t i = 0; i < places_map.size(); ++i) {
    if (i % step != 0 && i + 1 != places_map.size()) continue;
    trail.push_back(Json::array({to_centimetres(places_map[i].x()), to_centimetres(places_map[i].y())}));
  }
  return trail;
}

Json scan_json(const types::Scan& scan, const types::Se2& T_map_laser) {
  constexpr std::size_t kMostBeams = 90;
  constexpr double kCentimetres = 100.0;
  const std::span<const float> ranges = scan.ranges();
  Json centimetres = Json::array();
  for (std::size_t i = 0; i < ranges.size(); i += ranges.size() / kMostBeams + 1) {
    if (!types::is_hit(ranges[i])) continue;
    const double angle_rad = static_cast<double>(scan.angle_rad(i)), range_m = static_cast<double>(ranges[i]);
    const types::Vector2 end =
        T_map_laser * types::Vector2(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    for (const double metres : {end.x(), end.y()}) centimetres.push_back(std::lround(metres * kCentimetres));
  }
  return {{"cm", std::move(centimetres)}};
}

}  // namespace topo::daemon

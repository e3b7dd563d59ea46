// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/doubt_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace topo::daemon {

std::string doubt_text(const slam::MapDoubt& doubt) {
  if (!doubt.is_doubted()) return {};
  switch (doubt.reason) {
    case slam::DoubtReason::kLost:
      return fmt::format(
          "lost in {} of {} scans: they fit nowhere in the map and stand where the odometry says; expected "
          "scans that see walls, and each much of what the one before saw",
          doubt.scans.lost, doubt.scans.scans);
    case slam::DoubtReason::kContradicted:
      return fmt::format(
          "the map is doubted: {:.0f} % of what was seen twice lies in regions of {:g} m where most of it "
          "was seen elsewhere the other time; walls may stand twice there",
          100.0 * doubt.contradicted, slam::RevisitRegion::kSide_m);
    case slam::DoubtReason::kTension:
      return fmt::format(
          "the map is doubted: {:.0f} % of the places that were found again contradict the others",
          100.0 * doubt.tension);
    case slam::DoubtReason::kLoose:
      return fmt::format(
          "the map is doubted: on a part of the way odometry alone says how the robot turned, to some {:.0f} "
          "degrees, and no place was found again across it",
          doubt.loose_rad / types::kDegree_rad);
    case slam::DoubtReason::kShifted:
      return fmt::format(
          "the map is doubted: on a part of the way odometry alone says how far the robot went, to some "
          "{:.1f} m, and no place was found again across it",
          doubt.loose_m);
    case slam::DoubtReason::kDegenerate:
      break;
  }
  return fmt::format("the map is doubted: {} of {} scans leave one direction to odometry",
                     doubt.scans.degenerate, doubt.scans.scans);
}

nlohmann::json doubt_json(const slam::MapDoubt& doubt) {
  nlohmann::json json{{"figure", doubt.figure},
                      {"why", doubt_text(doubt)},
                      {"contradicted", doubt.contradicted},
                      {"lost", doubt.lost},
                      {"tension", doubt.tension},
                      {"degenerate", doubt.degenerate},
                      {"loose_rad", doubt.loose_rad},
                      {"loose_m", doubt.loose_m},
                      {"side_m", slam::RevisitRegion::kSide_m},
                      {"regions", nlohmann::json::array()},
                      {"loose", nlohmann::json::array()}};
  for (const slam::RevisitRegion& region : doubt.regions) {
    json["regions"].push_back({{"x_m", region.centre.x()},
                               {"y_m", region.centre.y()},
                               {"points", region.points},
                               {"contradicted", slam::contradicted_share(region)}});
  }
  for (const slam::LooseStep& step : doubt.loose) {
    json["loose"].push_back({{"x_m", step.before.x()},
                             {"y_m", step.before.y()},
                             {"sigma_rad", step.sigma_rad},
                             {"sigma_m", step.sigma_m}});
  }
  return json;
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/localise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/slam/whole_map.hpp"

namespace topo::slam {
namespace {

LocaliseRefusal gate(const Match& match, const LocaliseParams& params) {
  const bool fits = match.overlap >= params.overlap_min && match.response >= params.response_min;
  return fits ? LocaliseRefusal::kNone : LocaliseRefusal::kNothingFits;
}

/// Evidence for the part of the scan that the map shows.
double evidence_shown(const Peak& peak) {
  return peak.match.overlap > 0.0 ? peak.evidence / peak.match.overlap : 0.0;
}

bool is_rival(const Peak& other, const Peak& best, const LocaliseParams& params) {
  if (!apart(other.match.T_map_base, best.match.T_map_base, params.whole)) return false;
  if (other.evidence >= params.rival_ratio * best.evidence) return true;
  return other.match.overlap >= params.overlap_min &&
         evidence_shown(other) >= params.rival_ratio * evidence_shown(best);
}

}  // namespace

Localisation localise_near(const Session& session, const Cloud& cloud, const types::Se2& guess,
                           const MapperParams& mapper, const LocaliseParams& params) {
  Localisation out;
  if (session.keyframes.empty()) return out;
  std::vector<Point> points;
  select_points(cloud, mapper.cloud, points);
  float reach = 1.0F;
  for (const Point& p : points) reach = std::max(reach, p.norm());
  const SurfelMap map = thinned_map(session, guess.translation(),
                                    static_cast<double>(reach) + params.window.half_m + params.margin_m,
                                    mapper.refine.reach_m, params.whole.thin_m);
  const LikelihoodPyramid pyramid(map, mapper.search);
  const auto hit = search(pyramid, points, guess, params.window, params.score_min, mapper.search);
  Prior prior{guess, Eigen::Matrix3d::Zero()};
  const double trans = 1.0 / (params.guess_sigma_m * params.guess_sigma_m);
  prior.information.diagonal() << trans, trans, 1.0 / (params.guess_sigma_rad * params.guess_sigma_rad);
  out.match = refine(map, points, cloud.sensor, hit ? hit->T_map_base : guess, prior, mapper.refine);
  out.refusal = gate(out.match, params);
  return out;
}

Localisation localise_anywhere(const Session& session, const Cloud& cloud, const MapperParams& mapper,
                               const LocaliseParams& params) {
  Localisation out;
  if (session.keyframes.empty()) return out;
  out.refusal = LocaliseRefusal::kTooLarge;
  const auto map = WholeMap::of(session, params.whole, mapper.refine, mapper.free_ground);
  if (!map) return out;
  std::vector<Point> points;
  select_points(cloud, mapper.cloud, points);
  const std::vector<Peak> peaks = map->peaks(points, cloud.sensor);
  out.refusal = LocaliseRefusal::kNothingFits;
  if (peaks.empty()) return out;
  out.match = peaks.front().match;
  out.refusal = gate(out.match, params);
  if (!out.found()) return out;
  if (out.match.degenerate) out.refusal = LocaliseRefusal::kDegenerate;
  for (const Peak& other : peaks)
    if (is_rival(other, peaks.front(), params)) out.rivals.push_back(other.match);
  if (!out.rivals.empty()) out.refusal = LocaliseRefusal::kAmbiguous;
  return out;
}

std::string describe_pose(const Match& match) {
  std::array<char, 96> text{};
  const types::Se2& pose = match.T_map_base;
  std::snprintf(text.data(), text.size(), "x %.2f y %.2f theta %.2f (%.0f %% of the scan fits)", pose.x_m,
                pose.y_m, pose.theta_rad, 100.0 * match.response);
  return text.data();
}

std::string describe(const Localisation& localisation) {
  switch (localisation.refusal) {
    case LocaliseRefusal::kNone:
      return "found at " + describe_pose(localisation.match);
    case LocaliseRefusal::kNoMap:
      return "the session holds no map";
    case LocaliseRefusal::kTooLarge:
      return "the map is too large to be searched as a whole: give a pose";
    case LocaliseRefusal::kNothingFits:
      return "the scan fits nowhere well enough; best at " + describe_pose(localisation.match);
    case LocaliseRefusal::kDegenerate:
      return "the scan leaves open where along a wall it is; best at " + describe_pose(localisation.match) +
             ": drive to where more is to be seen, or give a pose";
    case LocaliseRefusal::kAmbiguous: {
      std::string places = describe_pose(localisation.match);
      for (const Match& rival : localisation.rivals) places += " and " + describe_pose(rival);
      return "places look alike: " + places + ": give a pose";
    }
  }
  return {};
}

}  // namespace topo::slam

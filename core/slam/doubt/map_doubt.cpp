// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/doubt/map_doubt.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "core/slam/closure_span.hpp"
#include "core/slam/heading_evidence.hpp"
#include "core/slam/odometry_evidence.hpp"

namespace topo::slam {
namespace {

/// Half a quarter turn: walls tell what is nearer to none of it than to a whole one.
constexpr double kQuarterIsClear_rad = 0.785;

double share_of(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

/// Share of the closures that the poses contradict: the solution left them out.
double tension_of(const Session& map, const GraphParams& params) {
  double closures = 0.0, contradicted = 0.0;
  for (const Edge& edge : map.edges) {
    if (!edge.robust) continue;
    closures += 1.0;
    if (edge_chi2(edge, map.poses) > params.contradicted_chi2) contradicted += 1.0;
  }
  return share_of(contradicted, closures);
}

/// Odometry that contradicts many matches is itself at fault, and says nothing against one of them.
bool is_odometry_sound(const Session& map, std::span<const WayStep> steps, const GraphParams& params,
                       const DoubtLimits& limits) {
  const auto contradicted = std::count_if(steps.begin(), steps.end(), [&](const WayStep& step) {
    const Edge& edge = *step.edge;
    return contradicting_odometry(edge, *map.keyframes[edge.from], *map.keyframes[edge.to], params.odometry)
        .has_value();
  });
  return static_cast<double>(contradicted) <= limits.odometry_at_fault * static_cast<double>(steps.size());
}

/// Of each keyframe: the wing whose direction its walls have, where it is sure that they have one.
using Wings = std::vector<std::optional<std::size_t>>;

Wings wings_of(const Session& map, const HeadingEvidenceParams& params) {
  Wings wings(map.keyframes.size());
  const auto building_rad = building_directions(map.keyframes, map.poses, params);
  for (std::size_t node = 0; node < wings.size(); ++node) {
    const auto walls = walls_against(*map.keyframes[node], map.poses[node], building_rad);
    if (walls && std::abs(walls->off_rad) <= params.near_rad) wings[node] = walls->wing;
  }
  return wings;
}

/// Whether one of two keyframes before the step sees walls of the direction that one of two after it sees.
bool do_walls_span(const Wings& wings, Way own_way, std::size_t place) {
  for (std::size_t before = place - std::min<std::size_t>(place, 2); before < place; ++before) {
    const auto& wing = wings[own_way[before]];
    for (std::size_t after = place; wing && after < std::min(place + 2, own_way.size()); ++after)
      if (wings[own_way[after]] == wing) return true;
  }
  return false;
}

/// Standard deviation along the less certain direction.
double sigma_m(const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix2d position = covariance.topLeftCorner<2, 2>();
  const double mean = 0.5 * position.trace();
  return std::sqrt(mean + std::sqrt(std::max(0.0, mean * mean - position.determinant())));
}

std::vector<LooseStep> loose_steps(const Session& map, Way own_way, const GraphParams& params,
                                   const DoubtLimits& limits) {
  const auto steps = way_steps(map.edges, map.poses, own_way, params.contradicted_chi2);
  const bool believes_odometry = is_odometry_sound(map, steps, params, limits);
  const Wings wings = wings_of(map, params.heading);
  std::vector<LooseStep> loose;
  for (const WayStep& step : steps) {
    if (step.spanned) continue;
    const Edge& edge = *step.edge;
    const Eigen::Matrix3d covariance = believes_odometry
                                           ? believed_covariance(edge, map.keyframes, params.odometry)
                                           : Eigen::Matrix3d(edge.information.inverse());
    LooseStep found{map.poses[own_way[step.place - 1]].translation(), std::sqrt(covariance(2, 2)),
                    sigma_m(covariance)};
    if (found.sigma_rad < kQuarterIsClear_rad && do_walls_span(wings, own_way, step.place))
      found.sigma_rad = 0.0;
    if (found.sigma_rad > params.loose_rad || found.sigma_m > params.loose_m) loose.push_back(found);
  }
  return loose;
}

/// Of the sum of the steps.
double deviation(std::span<const LooseStep> steps, double LooseStep::*sigma, double least) {
  double squares = 0.0;
  for (const LooseStep& step : steps)
    if (step.*sigma > least) squares += step.*sigma * step.*sigma;
  return std::sqrt(squares);
}

}  // namespace

double contradicted_share(const RevisitRegion& region) {
  return 1.0 - share_of(static_cast<double>(region.within), static_cast<double>(region.points));
}

MapDoubt doubt_of(const Session& map, Way own_way, const GraphParams& params, const ScanCount& scans,
                  const RevisitShare& revisits, const DoubtLimits& limits) {
  MapDoubt doubt;
  double in_doubt = 0.0;
  for (const RevisitRegion& region : revisits.regions) {
    if (region.points < limits.region_points || contradicted_share(region) < limits.region_contradicted)
      continue;
    doubt.regions.push_back(region);
    in_doubt += static_cast<double>(region.points);
  }
  const auto all = static_cast<double>(scans.scans);
  doubt.contradicted = share_of(in_doubt, static_cast<double>(revisits.points));
  doubt.lost = share_of(static_cast<double>(scans.lost), all);
  doubt.degenerate = share_of(static_cast<double>(scans.degenerate), all);
  doubt.tension = tension_of(map, params);
  doubt.loose = loose_steps(map, own_way, params, limits);
  doubt.loose_rad = deviation(doubt.loose, &LooseStep::sigma_rad, params.loose_rad);
  doubt.loose_m = deviation(doubt.loose, &LooseStep::sigma_m, params.loose_m);
  doubt.scans = scans;
  const std::pair<double, DoubtReason> figures[] = {
      {doubt.lost / limits.lost, DoubtReason::kLost},
      {doubt.contradicted / limits.contradicted, DoubtReason::kContradicted},
      {doubt.tension / limits.tension, DoubtReason::kTension},
      {doubt.loose_rad / limits.loose_rad, DoubtReason::kLoose},
      {doubt.loose_m / limits.loose_m, DoubtReason::kShifted},
      {doubt.degenerate / limits.degenerate, DoubtReason::kDegenerate}};
  const auto worst = std::max_element(std::begin(figures), std::end(figures),
                                      [](const auto& a, const auto& b) { return a.first < b.first; });
  doubt.figure = worst->first;
  doubt.reason = worst->second;
  return doubt;
}

}  // namespace topo::slam

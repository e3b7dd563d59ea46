// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/doubt/map_doubt.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "core/slam/closure_span.hpp"
#include "core/slam/heading_evidence.hpp"
#include "core/slam/odometry_evidence.hpp"
#include "core/types/se2.hpp"

namespace topo::slam {
namespace {

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

/// What a map's walls say of headings.
struct Walls {
  std::vector<std::optional<std::size_t>> wings;  ///< of each keyframe: whose direction its walls surely have
  /// A turn that is off by less cannot have put the walls of one wing, or of one quarter, in the direction of
  /// another.
  double clear_rad = std::numbers::pi / 4.0;
};

Walls walls_of(const Session& map, const HeadingEvidenceParams& params) {
  Walls walls;
  walls.wings.resize(map.keyframes.size());
  const auto building_rad = building_directions(map.keyframes, map.poses, params);
  for (std::size_t i = 0; i < building_rad.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      walls.clear_rad =
          std::min(walls.clear_rad, 0.5 * std::abs(types::within_quarter(building_rad[i] - building_rad[k])));
  }
  for (std::size_t node = 0; node < walls.wings.size(); ++node) {
    const auto against = walls_against(*map.keyframes[node], map.poses[node], building_rad);
    if (against && std::abs(against->off_rad) <= params.near_rad) walls.wings[node] = against->wing;
  }
  return walls;
}

/// Whether the keyframes before and after a step see walls of one direction, and the turn is not so uncertain
/// that these may be others. `match_rad`: the standard deviation of the match; `sigma_rad`: with what
/// odometry says against it, which was observed.
bool do_walls_span(const Walls& walls, std::size_t before, std::size_t after, double match_rad,
                   double sigma_rad) {
  const auto& wing = walls.wings[before];
  return wing && walls.wings[after] == wing && 2.0 * match_rad < walls.clear_rad &&
         sigma_rad < walls.clear_rad;
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
  const Walls walls = walls_of(map, params.heading);
  std::vector<LooseStep> loose;
  for (const WayStep& step : steps) {
    if (step.spanned) continue;
    const Edge& edge = *step.edge;
    const Eigen::Matrix3d matched = edge.information.inverse();
    const Eigen::Matrix3d covariance =
        believes_odometry ? believed_covariance(edge, map.keyframes, params.odometry) : matched;
    const std::size_t before = own_way[step.place - 1], after = own_way[step.place];
    LooseStep found{map.poses[before].translation(), std::sqrt(covariance(2, 2)), sigma_m(covariance)};
    if (do_walls_span(walls, before, after, std::sqrt(matched(2, 2)), found.sigma_rad)) found.sigma_rad = 0.0;
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

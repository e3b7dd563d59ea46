// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/arrival_trial.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/slam/refine.hpp"
#include "core/slam/whole_map.hpp"

namespace topo::slam {
namespace {

constexpr double kBeyond_m = 2.0;        ///< beyond reach and way
constexpr double kOdometryJump_m = 1.0;  ///< greater between two scans: odometry was reset, and is no way
constexpr std::size_t kComparedRayStride = 3;  ///< neighbouring rays cross the same surfaces
constexpr float kRayStep_m = 0.10F;
constexpr float kOnSurface_m = 0.08F;  ///< of a ray's sample: half a step, and the noise of the scanner
constexpr float kBehind_m = 0.40F;     ///< a ray that goes on this far behind a surface went through it
constexpr float kAcross = 0.5F;        ///< least sine of ray and surface: a grazing ray only passes by

/// What can be seen during the trial, from the arrival or from a rival.
double half_width_m(const Arrival& arrival, const MapperParams& mapper, const TrialParams& params) {
  double farthest_m = 0.0;
  for (const types::Se2& rival : arrival.rivals)
    farthest_m = std::max(farthest_m, distance_m(arrival.T_map_base, rival));
  return farthest_m + mapper.cloud.range_max_m + params.way_max_m + kBeyond_m;
}

/// How well the map explains the part of the scan that it shows.
double quality_of(const TrialEvidence& found) {
  constexpr double kContradictionCounts = 2.0;  // as in Peak::evidence
  return found.overlap > 0.0 ? found.fit - kContradictionCounts * found.contradiction / found.overlap : 0.0;
}

/// A surface that the map's own rays crossed is left out: a person or a team-mate stood there for a while.
bool crosses(const SurfelMap& map, const FreeGround& ground, const Point& from, const Point& to) {
  const Point way = to - from;
  const float length = way.norm();
  const Point direction = way / length;
  for (float at = kBehind_m; at + kBehind_m < length; at += kRayStep_m) {
    const Point p = from + direction * at;
    const Surfel* surfel = map.nearest(p);
    if (surfel == nullptr || (surfel->position - p).norm() > kOnSurface_m ||
        ground.is_crossed(surfel->position))
      continue;
    if (std::abs(surfel->normal.dot(direction)) > kAcross) return true;
  }
  return false;
}

TrialVerdict verdict_on(const TrialCount& count, const TrialParams& params) {
  if (count.recent_count >= params.recent && std::popcount(count.recent) >= params.recent_contradictions)
    return TrialVerdict::kDropped;
  if (count.way_m < params.way_m) return TrialVerdict::kRunning;
  const int told = count.matched + count.contradicted;
  if (count.matched >= params.matched_min * (told + count.silent)) return TrialVerdict::kPassed;
  if (count.way_m < params.way_max_m) return TrialVerdict::kRunning;
  // Where nothing contradicts, the ground is new, or two places are alike that far.
  return count.matched >= params.matched_min * told ? TrialVerdict::kPassed : TrialVerdict::kDropped;
}

}  // namespace

TrialFinding finding_of(const TrialEvidence& evidence, const TrialParams& params) {
  if (!evidence.tracked || evidence.contradiction > params.contradiction_max)
    return TrialFinding::kContradicts;
  if (evidence.overlap < params.overlap_min) return TrialFinding::kSaysNothing;
  if (evidence.fit < params.fit_min) return TrialFinding::kContradicts;
  return evidence.fits_rival ? TrialFinding::kSaysNothing : TrialFinding::kMatches;
}

TrialCount counted(TrialCount before, TrialFinding finding, double way_m, const TrialParams& params) {
  TrialCount now = before;
  if (now.verdict == TrialVerdict::kPassed || now.verdict == TrialVerdict::kDropped) return now;
  now.way_m += way_m;
  if (finding == TrialFinding::kSaysNothing) {
    ++now.silent;
  } else {
    const bool contradicts = finding == TrialFinding::kContradicts;
    ++(contradicts ? now.contradicted : now.matched);
    const std::uint32_t kept = (1U << static_cast<unsigned>(params.recent)) - 1U;
    now.recent = (now.recent << 1U | (contradicts ? 1U : 0U)) & kept;
    now.recent_count = std::min(now.recent_count + 1, params.recent);
  }
  now.verdict = verdict_on(now, params);
  return now;
}

ArrivalTrial::ArrivalTrial(const Session& session, const Arrival& arrival, const MapperParams& mapper,
                           const TrialParams& params)
    : mapper_(mapper),
      params_(params),
      old_(thinned_map(session, arrival.T_map_base.translation(), half_width_m(arrival, mapper, params),
                       mapper.refine.reach_m, params.thin_m)),
      ground_(seen_through(session.keyframes, session.poses, old_, mapper.free_ground)) {
  for (const types::Se2& rival : arrival.rivals) T_rival_map_.push_back(rival * arrival.T_map_base.inverse());
  count_.verdict = TrialVerdict::kRunning;
}

void ArrivalTrial::add(const Cloud& cloud, const types::Se2& T_map_base, const types::Se2& T_odom_base,
                       bool matched) {
  if (count_.verdict != TrialVerdict::kRunning) return;
  if (compared_ && !types::is_apart(*compared_, T_odom_base, params_.step_m, params_.step_rad)) return;
  double way_m = compared_ ? distance_m(*compared_, T_odom_base) : 0.0;
  if (way_m > kOdometryJump_m) way_m = 0.0;
  compared_ = T_odom_base;
  TrialEvidence found;
  if (matched) found = evidence(cloud, T_map_base);
  found.tracked = matched;
  count_ = counted(count_, finding_of(found, params_), way_m, params_);
}

TrialEvidence ArrivalTrial::evidence(const Cloud& cloud, const types::Se2& T_map_base) {
  select_points(cloud, mapper_.cloud, points_);
  TrialEvidence found = evidence_at(cloud.sensor, T_map_base);
  for (const types::Se2& T_rival_map : T_rival_map_) {
    const TrialEvidence there = evidence_at(cloud.sensor, T_rival_map * T_map_base);
    const bool fits =
        there.overlap >= params_.overlap_min && quality_of(there) >= params_.rival_ratio * quality_of(found);
    found.fits_rival = found.fits_rival || fits;
  }
  return found;
}

TrialEvidence ArrivalTrial::evidence_at(const Point& sensor, const types::Se2& T_map_base) const {
  Prior prior{T_map_base, Eigen::Matrix3d::Zero()};
  const double trans = 1.0 / (params_.drift_m * params_.drift_m);
  prior.information.diagonal() << trans, trans, 1.0 / (params_.drift_rad * params_.drift_rad);
  const Match match = refine(old_, points_, sensor, T_map_base, prior, mapper_.refine);
  const double through = seen_through_share(sensor, match.T_map_base);
  const double contradiction = ground_.contradiction(old_, points_, match.T_map_base) + through;
  return {true, match.overlap, match.fit(), contradiction, false};
}

double ArrivalTrial::seen_through_share(const Point& sensor, const types::Se2& T_map_base) const {
  const auto in_map = [&](const Point& p) {
    return Point((T_map_base * types::Vector2(p.cast<double>())).cast<float>());
  };
  const Point from = in_map(sensor);
  std::size_t rays = 0, through = 0;
  for (std::size_t i = 0; i < points_.size(); i += kComparedRayStride, ++rays)
    if (crosses(old_, ground_, from, in_map(points_[i]))) ++through;
  return rays > 0 ? static_cast<double>(through) / static_cast<double>(rays) : 0.0;
}

}  // namespace topo::slam

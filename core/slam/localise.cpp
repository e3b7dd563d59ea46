// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/localise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/slam/free_ground.hpp"
#include "core/slam/global_search.hpp"
#include "core/types/geometry.hpp"

namespace topo::slam {
namespace {

constexpr double kMargin_m = 2.0;    ///< around everything that the map holds
constexpr double kThin_m = 0.05;     ///< one surfel a cell and side of a wall is enough
constexpr double kPeakMin = 0.35;    ///< least likelihood of a coarse peak
constexpr double kPeakRatio = 0.80;  ///< a coarse peak this good against the best may refine to a better one
constexpr std::size_t kRayStride = 4;
/// What stands where the map was seen through speaks louder against a place than what the map does not know.
constexpr double kContradictionWeight = 2.0;

/// The whole map's bounds.
types::Rectangle bounds_of(const Session& session) {
  types::Rectangle box;
  for (std::size_t i = 0; i < session.keyframes.size(); ++i) {
    box.extend(session.poses[i].translation());
    for (const Surfel& s : session.keyframes[i]->surfels)
      box.extend(session.poses[i] * types::Vector2(s.position.cast<double>()));
  }
  return box;
}

/// Takes a surfel when it is the first of its cell and quarter of directions: a corridor that was driven ten
/// times has as many as one that was driven once.
class Thinner {
 public:
  Thinner(const Point& origin, double width_m)
      : origin_(origin),
        side_(static_cast<std::size_t>(std::ceil(width_m / kThin_m))),
        seen_(side_ * side_, 0) {}

  bool takes(const Point& position, const Point& normal) {
    const Point cell = (position - origin_) / static_cast<float>(kThin_m);
    if (!(cell.x() >= 0.0F && cell.y() >= 0.0F)) return false;
    const auto x = static_cast<std::size_t>(cell.x()), y = static_cast<std::size_t>(cell.y());
    if (x >= side_ || y >= side_) return false;
    const bool steep = std::abs(normal.y()) > std::abs(normal.x());
    const unsigned quarter = steep ? (normal.y() > 0.0F ? 0U : 1U) : (normal.x() > 0.0F ? 2U : 3U);
    unsigned char& seen = seen_[y * side_ + x];
    const unsigned before = seen;
    seen = static_cast<unsigned char>(before | 1U << quarter);
    return before != seen;
  }

 private:
  Point origin_;
  std::size_t side_;
  std::vector<unsigned char> seen_;
};

/// The session's surfels around a centre, thinned.
SurfelMap map_around(const Session& session, const types::Vector2& centre, double half_m,
                     const MapperParams& mapper) {
  SurfelMap map(mapper.refine.reach_m);
  map.reset(centre.cast<float>(), half_m);
  Thinner thinner(map.origin(), map.width_m());
  std::vector<Surfel> chosen;
  for (std::size_t i = 0; i < session.keyframes.size(); ++i) {
    const types::Se2& pose = session.poses[i];
    const auto c = static_cast<float>(std::cos(pose.theta_rad)),
               s = static_cast<float>(std::sin(pose.theta_rad));
    const Point t = pose.translation().cast<float>();
    chosen.clear();
    for (const Surfel& surfel : session.keyframes[i]->surfels) {
      const Point& p = surfel.position;
      const Point& n = surfel.normal;
      const Point position(c * p.x() - s * p.y() + t.x(), s * p.x() + c * p.y() + t.y());
      if (thinner.takes(position, Point(c * n.x() - s * n.y(), s * n.x() + c * n.y())))
        chosen.push_back(surfel);
    }
    map.add(chosen, pose);
  }
  return map;
}

/// The ground that the session's keyframes saw through: coarse, for where a robot can stand, and fine.
void see_through(const Session& session, StandingRoom& room, FreeGround& ground) {
  for (std::size_t i = 0; i < session.keyframes.size(); ++i) {
    const Keyframe& keyframe = *session.keyframes[i];
    const auto in_map = [&](const Point& p) {
      return Point((session.poses[i] * types::Vector2(p.cast<double>())).cast<float>());
    };
    const Point from = in_map(keyframe.sensor);
    room.add_ray(from, from);
    for (std::size_t k = 0; k < keyframe.match_points.size(); k += kRayStride) {
      const Point to = in_map(keyframe.match_points[k]);
      room.add_ray(from, to);
      ground.add_ray(from, to);
    }
  }
  room.close();
}

/// A place with what speaks for it: the share of points that fit less, weighted, the share that contradicts
/// the map.
struct Peak {
  Match match;
  double evidence = 0.0;
};

LocaliseRefusal gate(const Match& match, const LocaliseParams& params) {
  const bool fits = match.overlap >= params.overlap_min && match.response >= params.response_min;
  return fits ? LocaliseRefusal::kNone : LocaliseRefusal::kNothingFits;
}

bool apart(const types::Se2& a, const types::Se2& b, const LocaliseParams& params) {
  return (a.translation() - b.translation()).norm() > params.apart_m ||
         std::abs(types::wrap_angle(a.theta_rad - b.theta_rad)) > params.apart_rad;
}

/// Coarse peaks of the whole map, refined, the best evidence first.
std::vector<Peak> peaks_of(const Session& session, const SurfelMap& map, const Cloud& cloud,
                           std::span<const Point> points, const MapperParams& mapper,
                           const LocaliseParams& params) {
  const LikelihoodPyramid pyramid(map, params.search);
  StandingRoom room(pyramid, map.width_m());
  FreeGround ground(map.origin(), map.width_m());
  see_through(session, room, ground);
  std::vector<Exclusion> known;
  std::vector<Peak> peaks;
  double score_min = kPeakMin;
  for (int i = 0; i <= params.rivals_max; ++i) {
    const auto hit = search_everywhere(pyramid, room, points, score_min, known, params.search);
    if (!hit) break;
    if (i == 0) score_min = kPeakRatio * hit->score;
    known.push_back({hit->T_map_base, params.apart_m, params.apart_rad});
    const Match match = refine(map, points, cloud.sensor, hit->T_map_base, std::nullopt, mapper.refine);
    const double against = kContradictionWeight * ground.contradiction(map, points, match.T_map_base);
    peaks.push_back({match, match.response - against});
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.evidence > b.evidence; });
  return peaks;
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
  const SurfelMap map = map_around(session, guess.translation(),
                                   static_cast<double>(reach) + params.window.half_m + kMargin_m, mapper);
  const LikelihoodPyramid pyramid(map, mapper.search);
  const auto hit = search(pyramid, points, guess, params.window, 0.2, mapper.search);
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
  const types::Rectangle box = bounds_of(session);
  const double half_m = 0.5 * (box.max - box.min).maxCoeff() + kMargin_m;
  out.refusal = LocaliseRefusal::kTooLarge;
  if (2.0 * half_m > params.width_max_m) return out;
  std::vector<Point> points;
  select_points(cloud, mapper.cloud, points);
  const SurfelMap map = map_around(session, 0.5 * (box.min + box.max), half_m, mapper);
  const std::vector<Peak> peaks = peaks_of(session, map, cloud, points, mapper, params);
  out.refusal = LocaliseRefusal::kNothingFits;
  if (peaks.empty()) return out;
  out.match = peaks.front().match;
  out.refusal = gate(out.match, params);
  if (!out.found()) return out;
  if (out.match.degenerate) out.refusal = LocaliseRefusal::kDegenerate;
  const auto rival = std::find_if(peaks.begin(), peaks.end(), [&](const Peak& other) {
    return apart(other.match.T_map_base, out.match.T_map_base, params) &&
           other.evidence >= params.rival_ratio * peaks.front().evidence;
  });
  if (rival != peaks.end()) {
    out.rival = rival->match;
    out.refusal = LocaliseRefusal::kAmbiguous;
  }
  return out;
}

std::string describe(const Localisation& localisation) {
  const auto place = [](const Match& match) {
    std::array<char, 96> text{};
    const types::Se2& pose = match.T_map_base;
    std::snprintf(text.data(), text.size(), "x %.2f y %.2f theta %.2f (%.0f %% of the scan fits)", pose.x_m,
                  pose.y_m, pose.theta_rad, 100.0 * match.response);
    return std::string(text.data());
  };
  switch (localisation.refusal) {
    case LocaliseRefusal::kNone:
      return "found at " + place(localisation.match);
    case LocaliseRefusal::kNoMap:
      return "the session holds no map";
    case LocaliseRefusal::kTooLarge:
      return "the map is too large to be searched as a whole: give a pose";
    case LocaliseRefusal::kNothingFits:
      return "the scan fits nowhere well enough; best at " + place(localisation.match);
    case LocaliseRefusal::kDegenerate:
      return "the scan leaves open where along a wall it is; best at " + place(localisation.match) +
             ": drive to where more is to be seen, or give a pose";
    case LocaliseRefusal::kAmbiguous:
      return "two places look alike: " + place(localisation.match) + " and " +
             place(localisation.rival.value_or(localisation.match)) + ": give a pose";
  }
  return {};
}

}  // namespace topo::slam

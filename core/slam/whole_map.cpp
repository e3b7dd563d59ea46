// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/whole_map.hpp"

#include <algorithm>
#include <cmath>

namespace topo::slam {
namespace {

/// Bounding box of the map.
types::Rectangle bounds_of(const Session& session) {
  types::Rectangle box;
  for (std::size_t i = 0; i < session.keyframes.size(); ++i) {
    box.extend(session.poses[i].translation());
    for (const Surfel& s : session.keyframes[i]->content.surfels())
      box.extend(session.poses[i] * types::Vector2(s.position.cast<double>()));
  }
  return box;
}

/// Selects the first surfel of each cell and quadrant of normals: a corridor driven ten times has as many
/// surfels as one driven once.
class Thinner {
 public:
  Thinner(const Point& origin, double width_m, double cell_m)
      : origin_(origin),
        cell_m_(static_cast<float>(cell_m)),
        side_(static_cast<std::size_t>(std::ceil(width_m / cell_m))),
        seen_(side_ * side_, 0) {}

  bool takes(const Point& position, const Point& normal) {
    const Point cell = (position - origin_) / cell_m_;
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
  float cell_m_;
  std::size_t side_;
  std::vector<unsigned char> seen_;
};

/// Marks the ground crossed by the session's rays: coarse for the standing room, fine for contradictions.
void see_through(const Session& session, std::size_t ray_stride, StandingRoom& room, FreeGround& ground) {
  for (std::size_t i = 0; i < session.keyframes.size(); ++i) {
    const Keyframe& keyframe = *session.keyframes[i];
    const auto in_map = [&](const Point& p) {
      return Point((session.poses[i] * types::Vector2(p.cast<double>())).cast<float>());
    };
    const Point from = in_map(keyframe.sensor);
    room.add_ray(from, from);
    const std::vector<Point> points = keyframe.content.match_points();
    for (std::size_t k = 0; k < points.size(); k += ray_stride) {
      const Point to = in_map(points[k]);
      room.add_ray(from, to);
      ground.add_ray(from, to);
    }
  }
  room.close();
}

}  // namespace

bool apart(const types::Se2& a, const types::Se2& b, const WholeSearch& search) {
  return types::is_apart(a, b, search.apart_m, search.apart_rad);
}

SurfelMap thinned_map(const Session& session, const types::Vector2& centre, double half_m, double reach_m,
                      double thin_m) {
  SurfelMap map(reach_m);
  map.reset(centre.cast<float>(), half_m);
  Thinner thinner(map.origin(), map.width_m(), thin_m);
  std::vector<Surfel> chosen;
  for (std::size_t i = 0; i < session.keyframes.size(); ++i) {
    const types::Se2& pose = session.poses[i];
    const auto c = static_cast<float>(std::cos(pose.theta_rad)),
               s = static_cast<float>(std::sin(pose.theta_rad));
    const Point t = pose.translation().cast<float>();
    chosen.clear();
    for (const Surfel& surfel : session.keyframes[i]->content.surfels()) {
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

WholeMap::WholeMap(const Session& session, const types::Rectangle& box, double half_m,
                   const WholeSearch& search, const RefineParams& refine, const FreeGroundParams& ground)
    : search_(search),
      refine_(refine),
      map_(thinned_map(session, 0.5 * (box.min + box.max), half_m, refine.reach_m, search.thin_m)),
      levels_(map_, search.search),
      room_(levels_.pyramid(), map_.width_m()),
      ground_(map_.origin(), map_.width_m(), ground) {
  see_through(session, search.ray_stride, room_, ground_);
}

std::optional<WholeMap> WholeMap::of(const Session& session, const WholeSearch& search,
                                     const RefineParams& refine, const FreeGroundParams& ground) {
  if (session.keyframes.empty()) return std::nullopt;
  const types::Rectangle box = bounds_of(session);
  const double half_m = 0.5 * (box.max - box.min).maxCoeff() + search.margin_m;
  if (2.0 * half_m > search.width_max_m) return std::nullopt;
  return WholeMap(session, box, half_m, search, refine, ground);
}

std::vector<Peak> WholeMap::peaks(std::span<const Point> points, const Point& sensor) const {
  const PeakSearch wanted{search_.score_min, search_.peak_ratio,
                          static_cast<std::size_t>(search_.rivals_max) + 1, search_.apart_m,
                          search_.apart_rad};
  std::vector<Peak> peaks;
  for (const SearchHit& hit : search_everywhere(levels_, room_, points, wanted, search_.search))
    peaks.push_back(at(points, sensor, hit.T_map_base));
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.evidence > b.evidence; });
  return peaks;
}

Peak WholeMap::at(std::span<const Point> points, const Point& sensor, const types::Se2& pose) const {
  const Match match = refine(map_, points, sensor, pose, std::nullopt, refine_);
  return {match, match.response - search_.contradiction_weight * contradiction(points, match.T_map_base)};
}

}  // namespace topo::slam

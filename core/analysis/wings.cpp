// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/wings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/compass/extent.hpp"
#include "core/walls/wall_extraction.hpp"

namespace topo::analysis {
namespace {

using types::Segment;
using types::Vector2;

/// Squares of a rectangle of the plane, `side_m` wide, of which some are marked: one bit each.
class Squares {
 public:
  Squares(const types::Rectangle& box, double side_m)
      : side_m_(side_m),
        min_(side_m * (box.min / side_m).array().floor()),
        columns_(count(box.max.x() - min_.x())) {
    marked_.resize(columns_ * count(box.max.y() - min_.y()));
  }
  void mark(const Vector2& p) {
    if (const auto i = index_of(p)) marked_[*i] = true;
  }
  [[nodiscard]] bool hold(const Vector2& p) const {
    const auto i = index_of(p);
    return i && marked_[*i];
  }

 private:
  [[nodiscard]] std::size_t count(double length_m) const {
    return static_cast<std::size_t>(std::max(0.0, std::floor(length_m / side_m_))) + 1;
  }
  /// Nothing outside the rectangle.
  [[nodiscard]] std::optional<std::size_t> index_of(const Vector2& p) const {
    const Vector2 at = (p - min_) / side_m_;
    if (!(at.x() >= 0.0) || !(at.y() >= 0.0)) return std::nullopt;
    const auto x = static_cast<std::size_t>(at.x()), y = static_cast<std::size_t>(at.y());
    if (x >= columns_ || y >= marked_.size() / columns_) return std::nullopt;
    return y * columns_ + x;
  }

  double side_m_;
  Vector2 min_;
  std::size_t columns_;
  std::vector<bool> marked_;
};

/// The squares within about `near_m` of a wall, of those that hold points.
Squares squares_along(std::span<const Segment> walls, const types::Rectangle& points, double near_m) {
  // Half a square: a lattice askew to the squares leaves none out.
  const double step_m = 0.5 * near_m;
  Squares squares(points, near_m);
  for (const Segment& wall : walls) {
    const Vector2 way = wall.b - wall.a;
    const double length_m = way.norm();
    if (length_m == 0.0) continue;
    const Vector2 along = way / length_m, across{-along.y(), along.x()};
    const int steps = static_cast<int>(std::ceil(length_m / step_m));
    for (int i = -2; i <= steps + 2; ++i)
      for (int side = -2; side <= 2; ++side) squares.mark(wall.a + step_m * (i * along + side * across));
  }
  return squares;
}

std::vector<Vector2> away_from(std::span<const Segment> walls, std::span<const Vector2> points,
                               double near_m) {
  std::vector<Vector2> away;
  if (points.empty()) return away;
  const Squares near = squares_along(walls, compass::box_of(points), near_m);
  std::ranges::copy_if(points, std::back_inserter(away), [&](const Vector2& p) { return !near.hold(p); });
  return away;
}

double apart_rad(double a_rad, double b_rad) { return std::abs(types::within_quarter(a_rad - b_rad)); }

double length_m(std::span<const Segment> walls) {
  double sum_m = 0.0;
  for (const Segment& wall : walls) sum_m += wall.length_m();
  return sum_m;
}

}  // namespace

Wings skew_wings(std::span<const Vector2> occupied, std::span<const Vector2> wall_points,
                 double direction_rad, std::span<const Segment> walls, const compass::CompassParams& compass,
                 const walls::WallParams& wall_params, const WingParams& params) {
  Wings wings;
  compass::CompassParams of_rest = compass;
  of_rest.confidence_min = std::max(of_rest.confidence_min, params.confidence_min);  // spares its refinement
  std::vector<double> known_rad{direction_rad};
  std::vector<Segment> known(walls.begin(), walls.end());
  while (wings.directions_rad.size() < params.wings_max) {
    const std::vector<Vector2> rest = away_from(known, occupied, params.near_m);
    if (static_cast<double>(rest.size()) < params.share_min * static_cast<double>(occupied.size())) break;
    const compass::Compass found = compass::entropy_compass(rest, of_rest);
    if (!found.angle_rad) break;
    const auto is_known = [&](double one_rad) {
      return apart_rad(one_rad, *found.angle_rad) < params.apart_rad;
    };
    if (std::ranges::any_of(known_rad, is_known)) break;
    const std::vector<Segment> own =
        walls::extract_walls(away_from(known, wall_points, params.near_m), *found.angle_rad, wall_params);
    if (length_m(own) < params.walls_min_m) break;
    wings.directions_rad.push_back(*found.angle_rad);
    wings.walls.insert(wings.walls.end(), own.begin(), own.end());
    known_rad.push_back(*found.angle_rad);
    known.insert(known.end(), own.begin(), own.end());
  }
  return wings;
}

}  // namespace topo::analysis

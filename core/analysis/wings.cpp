// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/wings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/walls/wall_extraction.hpp"

namespace topo::analysis {
namespace {

using types::Segment;
using types::Vector2;

/// Squares of the plane, `side_m` wide.
class Squares {
 public:
  explicit Squares(double side_m) : side_m_(side_m) {}

  void add(const Vector2& p) { keys_.push_back(key_of(p)); }
  void sort() {
    std::ranges::sort(keys_);
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  }
  /// After sort().
  [[nodiscard]] bool hold(const Vector2& p) const { return std::ranges::binary_search(keys_, key_of(p)); }

 private:
  [[nodiscard]] std::uint64_t key_of(const Vector2& p) const {
    const auto index = [this](double v) {
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(v / side_m_)));
    };
    return static_cast<std::uint64_t>(index(p.y())) << 32U | index(p.x());
  }
  double side_m_;
  std::vector<std::uint64_t> keys_;
};

/// The squares within about `near_m` of a wall.
Squares squares_along(std::span<const Segment> walls, double near_m) {
  // Half a square: a lattice askew to the squares leaves none out.
  const double step_m = 0.5 * near_m;
  Squares squares(near_m);
  for (const Segment& wall : walls) {
    const Vector2 way = wall.b - wall.a;
    const double length_m = way.norm();
    if (length_m == 0.0) continue;
    const Vector2 along = way / length_m, across{-along.y(), along.x()};
    const int steps = static_cast<int>(std::ceil(length_m / step_m));
    for (int i = -2; i <= steps + 2; ++i)
      for (int side = -2; side <= 2; ++side) squares.add(wall.a + step_m * (i * along + side * across));
  }
  squares.sort();
  return squares;
}

std::vector<Vector2> away_from(std::span<const Segment> walls, std::span<const Vector2> points,
                               double near_m) {
  const Squares near = squares_along(walls, near_m);
  std::vector<Vector2> away;
  std::ranges::copy_if(points, std::back_inserter(away), [&](const Vector2& p) { return !near.hold(p); });
  return away;
}

/// Angle between two directions, which are the same after a quarter turn.
double apart_rad(double a_rad, double b_rad) {
  constexpr double kQuarterTurn = 0.5 * std::numbers::pi;
  return std::abs(std::remainder(a_rad - b_rad, kQuarterTurn));
}

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
  std::vector<double> known_rad{direction_rad};
  std::vector<Segment> known(walls.begin(), walls.end());
  while (wings.directions_rad.size() < params.wings_max) {
    const std::vector<Vector2> rest = away_from(known, occupied, params.near_m);
    if (static_cast<double>(rest.size()) < params.share_min * static_cast<double>(occupied.size())) break;
    const compass::Compass found = compass::entropy_compass(rest, compass);
    if (!found.angle_rad || found.confidence < params.confidence_min) break;
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

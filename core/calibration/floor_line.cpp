// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/floor_line.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <vector>

namespace topo::calibration {
namespace {

using types::Vector2;

/// A line by its foot: the direction from the scanner to it, and the distance.
struct Line {
  double foot_rad = 0.0, distance_m = 0.0;
  [[nodiscard]] Vector2 down() const { return {std::cos(foot_rad), std::sin(foot_rad)}; }
  [[nodiscard]] Vector2 along() const { return {-std::sin(foot_rad), std::cos(foot_rad)}; }
};

/// What of a line is seen, on both sides of its foot.
struct Support {
  double before_m = 0.0, behind_m = 0.0;
  [[nodiscard]] double covered_m() const { return before_m + behind_m; }
};

std::vector<Vector2> points_of(const StillPicture& picture, double range_max_m) {
  std::vector<Vector2> out;
  for (std::size_t i = 0; i < picture.range_m.size(); ++i)
    if (types::is_hit(picture.range_m[i]) && static_cast<double>(picture.range_m[i]) <= range_max_m)
      out.push_back(picture.point_m(i));
  return out;
}

Support support_of(const Line& line, const std::vector<Vector2>& points, double near_m) {
  constexpr double kPiece_m = 0.05;
  constexpr int kPieces = 100;  // to each side
  std::bitset<2 * kPieces> seen;
  const Vector2 down = line.down(), along = line.along();
  for (const Vector2& p : points) {
    if (std::abs(p.dot(down) - line.distance_m) > near_m) continue;
    const double piece = std::floor(p.dot(along) / kPiece_m) + kPieces;
    if (piece >= 0.0 && piece < 2.0 * kPieces) seen.set(static_cast<std::size_t>(piece));
  }
  const auto behind = static_cast<double>((seen >> kPieces).count());
  return {kPiece_m * (static_cast<double>(seen.count()) - behind), kPiece_m * behind};
}

bool is_floor(const Support& s, const FloorParams& params) {
  return s.covered_m() >= params.covered_min_m && std::min(s.before_m, s.behind_m) >= params.side_min_m;
}

/// True when next to nothing is seen below the line: it bounds the room.
bool is_lowest(const Line& line, const std::vector<Vector2>& points, const FloorParams& params) {
  const Vector2 down = line.down();
  const auto below = std::count_if(points.begin(), points.end(), [&](const Vector2& p) {
    return p.dot(down) > line.distance_m + 2.0 * params.near_m;
  });
  return static_cast<double>(below) <= params.below_max * static_cast<double>(points.size());
}

/// Least squares over the points near the line.
Line refined(const Line& line, const std::vector<Vector2>& points, double near_m) {
  const Vector2 down = line.down(), along = line.along();
  double n = 0.0, a = 0.0, d = 0.0, aa = 0.0, ad = 0.0;
  for (const Vector2& p : points) {
    const double across = p.dot(down), at = p.dot(along);
    if (std::abs(across - line.distance_m) > near_m) continue;
    n += 1.0, a += at, d += across, aa += at * at, ad += at * across;
  }
  const double det = n * aa - a * a;
  if (n < 2.0 || det <= 0.0) return line;
  const double slope = (n * ad - a * d) / det, at_foot = (d - slope * a) / n;
  return {types::wrap_angle(line.foot_rad - std::atan(slope)), at_foot * std::cos(std::atan(slope))};
}

/// The line that most is seen of whose foot is within the tilt of `foot_rad`.
std::optional<Line> best_line(const std::vector<Vector2>& points, double foot_rad,
                              const FloorParams& params) {
  constexpr double kTurn_rad = 1.5 * types::kDegree_rad, kStep_m = 0.02;
  std::optional<Line> best;
  double most_m = 0.0;
  for (double turn = -params.tilt_max_rad; turn <= params.tilt_max_rad; turn += kTurn_rad) {
    for (double distance = params.height_min_m; distance <= params.height_max_m; distance += kStep_m) {
      const Line line{foot_rad + turn, distance};
      const Support s = support_of(line, points, params.near_m);
      if (s.covered_m() <= most_m || !is_floor(s, params) || !is_lowest(line, points, params)) continue;
      most_m = s.covered_m();
      best = line;
    }
  }
  return best;
}

}  // namespace

std::optional<FloorLine> find_floor(const StillPicture& picture, double axis_rad, const FloorParams& params) {
  constexpr double kOther_rad = 180.0 * types::kDegree_rad;
  constexpr int kPasses = 3;
  const std::vector<Vector2> points = points_of(picture, params.aside_max_m);
  std::optional<FloorLine> floor;
  for (const double foot : {axis_rad, axis_rad + kOther_rad}) {
    auto line = best_line(points, foot, params);
    if (!line) continue;
    for (int i = 0; i < kPasses; ++i) line = refined(*line, points, 2.0 * params.near_m);
    if (floor && floor->height_m <= line->distance_m) continue;
    const Support s = support_of(*line, points, params.near_m);
    floor = FloorLine{types::wrap_angle(line->foot_rad), line->distance_m, s.covered_m()};
  }
  return floor;
}

}  // namespace topo::calibration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/scene_parts.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/sim/random.hpp"

namespace topo::sim {

namespace {

using Line = std::vector<Vector2>;

// One straight part of the wall as a box that extends half its thickness beyond both ends, so that corners
// close. Free ends beside an opening are not extended.
void add_part(const Vector2& a, const Vector2& b, bool over_a, bool over_b, const DrawnWall& wall,
              double z_min_m, std::vector<Prism>& out) {
  const Vector2 along = (b - a).normalized();
  const double half = 0.5 * wall.thickness_m;
  const Vector2 start = over_a ? Vector2(a - along * half) : a;
  const Vector2 end = over_b ? Vector2(b + along * half) : b;
  const Vector2 middle = 0.5 * (start + end);
  out.push_back(make_box({middle.x(), middle.y(), std::atan2(along.y(), along.x())}, (end - start).norm(),
                         wall.thickness_m, z_min_m, wall.z_max_m));
}

struct Piece {
  Line points;
  bool open_begin = false;  // an opening before it
  bool open_end = false;
};

void add_piece(const Piece& piece, const DrawnWall& wall, std::vector<Prism>& out) {
  for (std::size_t i = 0; i + 1 < piece.points.size(); ++i) {
    if ((piece.points[i + 1] - piece.points[i]).norm() < 1e-9) continue;
    const bool first = i == 0;
    const bool last = i + 2 == piece.points.size();
    add_part(piece.points[i], piece.points[i + 1], !(first && piece.open_begin), !(last && piece.open_end),
             wall, wall.z_min_m, out);
  }
}

// The features of one straight part, which begins `offset_m` along the wall.
std::string add_features(const DrawnWall& wall, const Vector2& a, const Vector2& b, double offset_m,
                         Piece& piece, std::vector<Prism>& out) {
  const Vector2 along = (b - a).normalized();
  const double length_m = (b - a).norm();
  double used_m = 0.0;
  for (const WallFeature& f : wall.features) {
    const double low_m = f.at_m - 0.5 * f.width_m - offset_m;
    const double high_m = f.at_m + 0.5 * f.width_m - offset_m;
    if (high_m <= 0.0 || low_m >= length_m) continue;
    if (low_m < used_m || high_m > length_m) {
      return fmt::format(
          "from {:g} to {:g} m overlaps another or a corner; the straight part goes from {:g} to {:g} m",
          low_m + offset_m, high_m + offset_m, offset_m, offset_m + length_m);
    }
    used_m = high_m;
    const Vector2 p = a + along * low_m;
    const Vector2 q = a + along * high_m;
    piece.points.push_back(p);
    if (f.kind == WallFeature::Kind::kAlcove) {
      const Vector2 aside = (f.left ? 1.0 : -1.0) * f.depth_m * Vector2(-along.y(), along.x());
      piece.points.insert(piece.points.end(), {p + aside, q + aside, q});
      continue;
    }
    piece.open_end = true;
    add_piece(piece, wall, out);
    piece = {{q}, true, false};
    if (f.lintel_m > 0.0) add_part(p, q, false, false, wall, f.lintel_m, out);
  }
  return {};
}

// One row between two positions of a straight part, if there is enough space.
void add_row(const WallClutter& clutter, const DrawnWall& wall, const Vector2& a, const Vector2& along,
             double from_m, double to_m, std::uint64_t number, std::vector<Prism>& out) {
  const double low_m = from_m + clutter.margin_m;
  const double high_m = to_m - clutter.margin_m;
  if (high_m - low_m < clutter.row.length_min_m) return;
  const Vector2 aside = (clutter.left ? 0.5 : -0.5) * wall.thickness_m * Vector2(-along.y(), along.x());
  ClutterRow row = clutter.row;
  row.seed = derive_seed(row.seed, number);
  row.from = a + along * (clutter.left ? low_m : high_m) + aside;
  row.to = a + along * (clutter.left ? high_m : low_m) + aside;
  build_clutter(row, out);
}

// `features` must be sorted by position.
void add_clutter(const DrawnWall& wall, const WallClutter& clutter, std::vector<Prism>& out) {
  double offset_m = 0.0;
  std::uint64_t number = 0;
  for (std::size_t i = 0; i + 1 < wall.points.size(); ++i) {
    const Vector2& a = wall.points[i];
    const double length_m = (wall.points[i + 1] - a).norm();
    const Vector2 along = (wall.points[i + 1] - a) / length_m;
    double from_m = 0.0;
    for (const WallFeature& f : wall.features) {
      const double low_m = f.at_m - 0.5 * f.width_m - offset_m;
      if (low_m < 0.0 || low_m >= length_m) continue;
      add_row(clutter, wall, a, along, from_m, low_m, ++number, out);
      from_m = low_m + f.width_m;
    }
    add_row(clutter, wall, a, along, from_m, length_m, ++number, out);
    offset_m += length_m;
  }
}

}  // namespace

std::string build_wall(DrawnWall wall, std::vector<Prism>& out) {
  std::sort(wall.features.begin(), wall.features.end(),
            [](const WallFeature& a, const WallFeature& b) { return a.at_m < b.at_m; });
  double offset_m = 0.0;
  Piece piece{{wall.points.front()}, false, false};
  for (std::size_t i = 0; i + 1 < wall.points.size(); ++i) {
    const Vector2& a = wall.points[i];
    const Vector2& b = wall.points[i + 1];
    if (std::string fault = add_features(wall, a, b, offset_m, piece, out); !fault.empty()) return fault;
    piece.points.push_back(b);
    offset_m += (b - a).norm();
  }
  add_piece(piece, wall, out);
  for (const WallFeature& f : wall.features) {
    if (f.at_m - 0.5 * f.width_m < 0.0 || f.at_m + 0.5 * f.width_m > offset_m) {
      return fmt::format("at {:g} m is beyond the wall, which is {:g} m long", f.at_m, offset_m);
    }
  }
  for (const WallClutter& clutter : wall.clutter) add_clutter(wall, clutter, out);
  return {};
}

void build_clutter(const ClutterRow& row, std::vector<Prism>& out) {
  Random random(row.seed);
  const double length_m = (row.to - row.from).norm();
  std::vector<double> lengths;
  double taken_m = 0.0;
  while (taken_m < row.fraction * length_m) {
    const double rest_m = row.fraction * length_m - taken_m;
    lengths.push_back(std::min(random.uniform(row.length_min_m, row.length_max_m), rest_m));
    taken_m += lengths.back();
  }
  // Distributes the remaining length over the gaps, including both ends.
  std::vector<double> gaps(lengths.size() + 1);
  for (double& gap : gaps) gap = random.uniform();
  const double scale = std::max(0.0, length_m - taken_m) / std::accumulate(gaps.begin(), gaps.end(), 1e-12);
  const Vector2 along = (row.to - row.from) / length_m;
  const Vector2 aside(-along.y(), along.x());
  const double heading = std::atan2(along.y(), along.x());
  double at_m = 0.0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    at_m += gaps[i] * scale;
    const double depth_m = random.uniform(row.depth_min_m, row.depth_max_m);
    const Vector2 middle = row.from + along * (at_m + 0.5 * lengths[i]) + aside * (0.5 * depth_m);
    out.push_back(make_box({middle.x(), middle.y(), heading}, lengths[i], depth_m, 0.0,
                           random.uniform(row.height_min_m, row.height_max_m)));
    at_m += lengths[i];
  }
}

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/wall_extraction.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/walls/wall_lines.hpp"

namespace topo::walls {
namespace {

using Points = std::span<const types::Vector2>;

/// Consecutive points along one line without a gap.
struct Run {
  int line;
  std::span<const Place> places;  ///< ascending by u
  [[nodiscard]] float from() const { return places.front().u; }
  [[nodiscard]] float to() const { return places.back().u; }
};

/// Finds the walls of one direction.
class WallFinder {
 public:
  WallFinder(const WallLines& lines, const Direction& direction, const WallParams& params)
      : params_(params), along_(direction), lines_(lines), walls_on_(lines_.size()) {}

  void append_to(std::vector<types::Segment>& segments) {
    std::vector<Run> runs;
    for (const WallLines::Stretch& stretch : lines_.stretches())
      runs.push_back({static_cast<int>(stretch.line), lines_.places_of(stretch)});
    // A wall has a run in each line that it touches: the fullest run is its local maximum.
    const auto fuller = [](const Run& a, const Run& b) {
      return std::make_tuple(b.places.size(), a.line, a.from()) <
             std::make_tuple(a.places.size(), b.line, b.from());
    };
    std::sort(runs.begin(), runs.end(), fuller);
    for (const Run& run : runs) accept_uncovered(run);
    for (const auto& walls : walls_on_)
      for (const Run& wall : walls) segments.push_back(segment_of(wall));
  }

 private:
  /// Accepts the parts of a run that no fuller run beside it explains, if they still are walls.
  void accept_uncovered(const Run& run) {
    std::vector<Run> beside;
    const int last = static_cast<int>(walls_on_.size()) - 1;
    const int reach = params_.same_wall_half_bins;
    for (int line = std::max(0, run.line - reach); line <= std::min(last, run.line + reach); ++line) {
      for (const Run& wall : walls_on_[static_cast<std::size_t>(line)]) {
        if (wall.from() <= run.to() && wall.to() >= run.from()) beside.push_back(wall);
      }
    }
    std::sort(beside.begin(), beside.end(), [](const Run& a, const Run& b) { return a.from() < b.from(); });
    const Place* at = run.places.data();
    const Place* const end = at + run.places.size();
    for (const Run& wall : beside) {
      const Place* stop =
          std::lower_bound(at, end, wall.from(), [](const Place& p, float u) { return p.u < u; });
      accept({run.line, {at, stop}});
      at =
          std::max(at, std::upper_bound(at, end, wall.to(), [](float u, const Place& p) { return u < p.u; }));
    }
    accept({run.line, {at, end}});
  }

  /// Number of points expected on a line beside the run.
  [[nodiscard]] double expected_beside(const Run& run) const {
    const auto lower = [](const Place& p, float u) { return p.u < u; };
    const auto upper = [](float u, const Place& p) { return u < p.u; };
    std::ptrdiff_t sum = 0;
    const int from = params_.band_from_half_bins, width = params_.band_half_bins;
    for (int away = from; away < from + width; ++away) {
      for (const int bin : {run.line - away, run.line + 1 + away}) {
        if (bin < 0 || bin >= static_cast<int>(lines_.size())) continue;
        const auto places = lines_.bin(static_cast<std::size_t>(bin));
        const auto first = std::lower_bound(places.begin(), places.end(), run.from(), lower);
        sum += std::upper_bound(first, places.end(), run.to(), upper) - first;
      }
    }
    return static_cast<double>(sum) / width;  // two half bins per line, two bands
  }

  void accept(const Run& run) {
    if (!is_wall_run(run.places, params_)) return;
    // In clutter (chairs, shelves) every line is full: a wall must exceed the lines beside it.
    if (static_cast<double>(run.places.size()) < params_.contrast_min * expected_beside(run)) return;
    walls_on_[static_cast<std::size_t>(run.line)].push_back(run);
  }

  [[nodiscard]] types::Segment segment_of(const Run& run) const {
    double v = 0.0;
    for (const Place& place : run.places) v += static_cast<double>(place.v);
    v /= static_cast<double>(run.places.size());
    const auto point = [&](float u) {
      const auto along = static_cast<double>(u);
      return types::Vector2(along_.cos * along - along_.sin * v, along_.sin * along + along_.cos * v);
    };
    return {point(run.from()), point(run.to())};
  }

  const WallParams& params_;
  Direction along_;
  const WallLines& lines_;
  std::vector<std::vector<Run>> walls_on_;
};

}  // namespace

std::vector<types::Vector2> wall_points(const WallStore& store, const WallHeights& params) {
  std::vector<types::Vector2> points;
  store.columns().for_each([&](patricia::Key key, Slabs slabs) {
    if (!is_wall(slabs, params)) return;
    const auto cell = patricia::cell_of(key);
    points.emplace_back((cell.x + 0.5) * store.resolution_m(), (cell.y + 0.5) * store.resolution_m());
  });
  return points;
}

std::vector<types::Segment> extract_walls(Points points, double compass_rad, const WallParams& params) {
  std::vector<types::Segment> walls;
  if (points.empty()) return walls;
  const double c = std::cos(compass_rad), s = std::sin(compass_rad);
  for (const Direction& direction : {Direction{c, s}, Direction{-s, c}}) {
    const WallLines lines(points, direction, params);
    WallFinder(lines, direction, params).append_to(walls);
  }
  return walls;
}

}  // namespace topo::walls

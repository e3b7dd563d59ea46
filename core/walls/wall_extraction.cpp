// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/wall_extraction.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <tuple>

namespace topo::walls {
namespace {

using Points = std::span<const types::Vector2>;

/// A point by where it is along the walls looked for, and across.
struct Place {
  float u;
  float v;
};

bool is_before(const Place& a, const Place& b) { return a.u < b.u || (a.u == b.u && a.v < b.v); }

/// As std::merge, without a branch that nobody can predict.
void merge(std::span<const Place> a, std::span<const Place> b, std::span<Place> out) {
  const Place *at_a = a.data(), *at_b = b.data();
  const Place *const end_a = at_a + a.size(), *const end_b = at_b + b.size();
  Place* to = out.data();
  while (at_a != end_a && at_b != end_b) {
    const bool second = is_before(*at_b, *at_a);
    *to++ = *(second ? at_b : at_a);
    at_a += second ? 0 : 1;
    at_b += second ? 1 : 0;
  }
  std::copy(at_b, end_b, std::copy(at_a, end_a, to));
}

/// Points that follow each other along one line without a gap.
struct Run {
  int line;
  std::span<const Place> places;  ///< ascending by u
  [[nodiscard]] float from() const { return places.front().u; }
  [[nodiscard]] float to() const { return places.back().u; }
};

/// The points of one direction in lines of overlapping bins: line i holds what lies in half bins i and i + 1,
/// by u. A wall of less than half a bin is then whole in some line, wherever it lies.
class Lines {
 public:
  /// Direction (c, s) of the walls.
  Lines(Points points, double c, double s, double half_bin_m) {
    std::vector<double> across(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) across[k] = c * points[k].y() - s * points[k].x();
    double low_m = across.front(), high_m = across.front();
    for (const double v : across) {
      low_m = v < low_m ? v : low_m;
      high_m = high_m < v ? v : high_m;
    }
    // A few points far out must not ask for more bins than there are points to put into them.
    const double bins_max = 1000.0 + 8.0 * static_cast<double>(points.size());
    const double wide_m = high_m - low_m, width_m = std::max(half_bin_m, wide_m / bins_max);
    first_.assign(static_cast<std::size_t>(wide_m / width_m) + 2, 0);
    // Signed numbers, of which vector instructions are made.
    std::vector<std::int32_t> bins(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      bins[k] = static_cast<std::int32_t>((across[k] - low_m) / width_m);
    for (const std::int32_t bin : bins) ++first_[static_cast<std::size_t>(bin) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    places_.resize(points.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t k = 0; k < points.size(); ++k)
      places_[next[static_cast<std::size_t>(bins[k])]++] = {
          static_cast<float>(c * points[k].x() + s * points[k].y()), static_cast<float>(across[k])};
    sort_bins();
  }

  [[nodiscard]] std::size_t size() const { return first_.size() - 1; }
  [[nodiscard]] std::span<const Place> bin(std::size_t i) const {
    return std::span(places_).subspan(first_[i], first_[i + 1] - first_[i]);
  }

 private:
  void sort_bins() {
    for (std::size_t i = 0; i + 1 < first_.size(); ++i) {
      const auto begin = places_.begin() + static_cast<std::ptrdiff_t>(first_[i]),
                 end = places_.begin() + static_cast<std::ptrdiff_t>(first_[i + 1]);
      // Of points row by row most bins are in order along one of the two directions.
      if (!std::is_sorted(begin, end, is_before)) std::sort(begin, end, is_before);
    }
  }

  std::vector<std::size_t> first_;  ///< of every half bin, and one past the last
  std::vector<Place> places_;
};

/// Share of a run's length, in bins, that points were seen on.
double filled_share(std::span<const Place> places, double bin_m) {
  const float per_m = static_cast<float>(1.0 / bin_m);
  int filled = 0, last = -1;
  for (const Place& place : places) {
    const int slot = static_cast<int>((place.u - places.front().u) * per_m);
    if (slot != last) ++filled;
    last = slot;
  }
  return static_cast<double>(filled) / (last + 1);
}

std::size_t points_min(const WallParams& params) {
  return static_cast<std::size_t>(std::max(params.points_min, 2));
}

/// What is long, full and dense enough to be a wall.
bool is_wall_run(std::span<const Place> places, const WallParams& params) {
  if (places.size() < points_min(params)) return false;
  // A hair of slack: 20 cells of 0.05 m are a metre, whatever the rounding of the projection says.
  const double length_m = static_cast<double>(places.back().u - places.front().u) + 1e-3;
  return length_m >= params.length_min_m && filled_share(places, params.bin_m) >= params.filled_min;
}

/// Cuts a line at its gaps.
template <class F>
void for_contiguous(std::span<const Place> places, double gap_max_m, F&& f) {
  const auto gap_m = static_cast<float>(gap_max_m);
  std::size_t first = 0;
  for (std::size_t i = 1; i <= places.size(); ++i) {
    if (i < places.size() && places[i].u - places[i - 1].u <= gap_m) continue;
    if (i > first) f(places.subspan(first, i - first));
    first = i;
  }
}

/// Walls of one direction.
class WallFinder {
 public:
  WallFinder(Points points, double c, double s, const WallParams& params)
      : params_(params), c_(c), s_(s), lines_(points, c, s, params.bin_m / 2.0), walls_on_(lines_.size()) {
    merged_.reserve(2 * points.size());
  }

  void append_to(std::vector<types::Segment>& segments) {
    std::vector<Run> runs = candidates();
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
  /// Runs of all lines. A wall gives one in each line that it touches: the fullest is its local maximum.
  std::vector<Run> candidates() {
    std::vector<Run> runs;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const auto low = lines_.bin(i);
      const auto high = i + 1 < lines_.size() ? lines_.bin(i + 1) : std::span<const Place>();
      if (low.size() + high.size() < points_min(params_)) continue;
      const std::size_t first = merged_.size();
      merged_.resize(first + low.size() + high.size());  // reserved: spans stay valid
      const std::span line = std::span(merged_).subspan(first);
      merge(low, high, line);
      for_contiguous(line, params_.gap_max_m, [&](std::span<const Place> places) {
        if (is_wall_run(places, params_)) runs.push_back({static_cast<int>(i), places});
      });
    }
    return runs;
  }

  /// Takes from a run what no fuller one beside it explains, when that is a wall still.
  void accept_uncovered(const Run& run) {
    std::vector<Run> beside;
    const int last = static_cast<int>(walls_on_.size()) - 1;
    for (int line = std::max(0, run.line - kBeside); line <= std::min(last, run.line + kBeside); ++line) {
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

  /// Points beside a run, as many as one would expect on a line there.
  [[nodiscard]] double expected_beside(const Run& run) const {
    const auto lower = [](const Place& p, float u) { return p.u < u; };
    const auto upper = [](float u, const Place& p) { return u < p.u; };
    std::ptrdiff_t sum = 0;
    for (int away = kGapBeside; away < kGapBeside + kBandBeside; ++away) {
      for (const int bin : {run.line - away, run.line + 1 + away}) {
        if (bin < 0 || bin >= static_cast<int>(lines_.size())) continue;
        const auto places = lines_.bin(static_cast<std::size_t>(bin));
        const auto first = std::lower_bound(places.begin(), places.end(), run.from(), lower);
        sum += std::upper_bound(first, places.end(), run.to(), upper) - first;
      }
    }
    return static_cast<double>(sum) / kBandBeside;  // two half bins a line, two bands
  }

  void accept(const Run& run) {
    if (!is_wall_run(run.places, params_)) return;
    // Among chairs and shelves every line is full: a wall stands out from what is beside it.
    if (static_cast<double>(run.places.size()) < params_.contrast_min * expected_beside(run)) return;
    walls_on_[static_cast<std::size_t>(run.line)].push_back(run);
  }

  [[nodiscard]] types::Segment segment_of(const Run& run) const {
    double v = 0.0;
    for (const Place& place : run.places) v += static_cast<double>(place.v);
    v /= static_cast<double>(run.places.size());
    const auto point = [&](float u) {
      const auto along = static_cast<double>(u);
      return types::Vector2(c_ * along - s_ * v, s_ * along + c_ * v);
    };
    return {point(run.from()), point(run.to())};
  }

  /// Half bins to each side in which a run beside a fuller one is the same wall: two bins, the thickness of a
  /// partition seen from both sides.
  static constexpr int kBeside = 4;

  /// Where in half bins the band begins that a wall must stand out from (what is nearer may be its own), and
  /// how wide it is, on each side.
  static constexpr int kGapBeside = 3;
  static constexpr int kBandBeside = 6;

  const WallParams& params_;
  double c_;
  double s_;
  Lines lines_;
  std::vector<Place> merged_;
  std::vector<std::vector<Run>> walls_on_;
};

/// Of an occupied cell that is not on the map's border.
bool on_surface(const grid::CellState* at, std::ptrdiff_t up) {
  const auto is_occupied = [at](std::ptrdiff_t by) { return at[by] == grid::CellState::kOccupied; };
  return !(is_occupied(1) && is_occupied(-1) && is_occupied(up) && is_occupied(-up));
}

}  // namespace

std::vector<types::Vector2> wall_points(const WallStore& store) {
  std::vector<types::Vector2> points;
  store.columns().for_each([&](patricia::Key key, Slabs slabs) {
    if (!is_wall(slabs)) return;
    const auto cell = patricia::cell_of(key);
    points.emplace_back((cell.x + 0.5) * store.resolution_m(), (cell.y + 0.5) * store.resolution_m());
  });
  return points;
}

std::vector<types::Vector2> occupied_points(const grid::DenseMap& map) {
  static_assert(sizeof(grid::CellState) == 1);
  std::vector<types::Vector2> points;
  const auto width = static_cast<std::size_t>(map.width());
  for (int y = map.box.min.y; y <= map.box.max.y && width > 0; ++y) {
    const grid::CellState* const row = &map.cells[map.index({map.box.min.x, y})];
    const grid::CellState* const end = row + width;
    const bool is_outermost = y == map.box.min.y || y == map.box.max.y;
    const double y_m = map.centre_of({map.box.min.x, y}).y();
    for (const grid::CellState* at = row; at != end; ++at) {
      if (*at != grid::CellState::kOccupied) {
        // Most cells are not occupied: the library looks at many at once.
        at = static_cast<const grid::CellState*>(std::memchr(at, static_cast<int>(grid::CellState::kOccupied),
                                                             static_cast<std::size_t>(end - at)));
        if (at == nullptr) break;
      }
      // All is unknown outside of the map.
      if (is_outermost || at == row || at + 1 == end || on_surface(at, map.width()))
        points.emplace_back(map.centre_of({map.box.min.x + static_cast<int>(at - row), y}).x(), y_m);
    }
  }
  return points;
}

std::vector<types::Segment> extract_walls(Points points, double compass_rad, const WallParams& params) {
  std::vector<types::Segment> walls;
  if (points.empty()) return walls;
  const double c = std::cos(compass_rad), s = std::sin(compass_rad);
  WallFinder(points, c, s, params).append_to(walls);
  WallFinder(points, -s, c, params).append_to(walls);
  return walls;
}

}  // namespace topo::walls

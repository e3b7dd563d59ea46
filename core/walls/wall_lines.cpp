// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/walls/wall_lines.hpp"

#include <algorithm>

namespace topo::walls {
namespace {

using Points = std::span<const types::Vector2>;

bool is_before(const Place& a, const Place& b) { return a.u < b.u || (a.u == b.u && a.v < b.v); }

/// As std::merge, without its unpredictable branch. Returns `out`.
std::span<const Place> merge(std::span<const Place> a, std::span<const Place> b, std::span<Place> out) {
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
  return out;
}

/// Fraction of a run's bins that contain points.
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

/// Splits a line at its gaps: calls f(first, count) for each part.
template <class F>
void for_contiguous(std::span<const Place> places, double gap_max_m, F&& f) {
  const auto gap_m = static_cast<float>(gap_max_m);
  std::size_t first = 0;
  for (std::size_t i = 1; i <= places.size(); ++i) {
    if (i < places.size() && places[i].u - places[i - 1].u <= gap_m) continue;
    if (i > first) f(first, i - first);
    first = i;
  }
}

}  // namespace

bool is_wall_run(std::span<const Place> places, const WallParams& params) {
  if (places.size() < points_min(params)) return false;
  // Tolerance: 20 cells of 0.05 m are a metre despite the rounding of the projection.
  const double length_m = static_cast<double>(places.back().u - places.front().u) + 1e-3;
  return length_m >= params.length_min_m && filled_share(places, params.bin_m) >= params.filled_min;
}

WallLines::WallLines(Points points, const Direction& direction, const WallParams& params)
    : layout_(layout_of(
          compass::extent_of(points, [&](const types::Vector2& p) { return direction.across_m(p); }),
          points.size(), direction, params.bin_m / 2.0)) {
  fill_bins(points);
  fill_lines(params);
}

WallLines::Layout WallLines::layout_of(const compass::Extent& across, std::size_t points,
                                       const Direction& direction, double half_bin_m) {
  // A few distant points must not require many more bins than there are points.
  const double bins_max = 1000.0 + 8.0 * static_cast<double>(points);
  const double wide_m = across.high - across.low, width_m = std::max(half_bin_m, wide_m / bins_max);
  return {direction, across.low, width_m, static_cast<std::size_t>(wide_m / width_m) + 1};
}

void WallLines::fill_bins(Points points) {
  const Layout layout = layout_;
  std::vector<std::int32_t> bins(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) bins[k] = layout.bin(layout.along.across_m(points[k]));
  first_.assign(layout.bins + 2, 0);
  for (const std::int32_t bin : bins) ++first_[static_cast<std::size_t>(bin) + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  places_.resize(points.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 2);
  for (std::size_t k = 0; k < points.size(); ++k)
    places_[next[static_cast<std::size_t>(bins[k])]++] = layout.place(points[k]);
  sort_bins();
}

void WallLines::sort_bins() {
  for (std::size_t i = 0; i < layout_.bins; ++i) {
    const auto begin = places_.begin() + static_cast<std::ptrdiff_t>(first_[i]),
               end = places_.begin() + static_cast<std::ptrdiff_t>(first_[i + 1]);
    // For points row by row, most bins are in order along one of the two directions.
    if (!std::is_sorted(begin, end, is_before)) std::sort(begin, end, is_before);
  }
}

void WallLines::fill_lines(const WallParams& params) {
  merged_.resize(start_of(layout_.bins));
  for (std::size_t line = 0; line < layout_.bins; ++line) {
    const auto low = bin(line), high = bin(line + 1);
    const std::size_t size = low.size() + high.size();
    if (size < points_min(params)) continue;
    find_stretches(line, merge(low, high, std::span(merged_).subspan(start_of(line), size)), params);
  }
}

void WallLines::find_stretches(std::size_t line, std::span<const Place> places, const WallParams& params) {
  for_contiguous(places, params.gap_max_m, [&](std::size_t first, std::size_t count) {
    if (is_wall_run(places.subspan(first, count), params)) stretches_.push_back({line, first, count});
  });
}

}  // namespace topo::walls

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/compass/extent.hpp"
#include "core/types/geometry.hpp"
#include "core/walls/wall_params.hpp"

namespace topo::walls {

/// A point by its position along the walls (u) and across them (v).
struct Place {
  float u;
  float v;
};

/// Direction of walls.
struct Direction {
  double cos, sin;
  [[nodiscard]] double across_m(const types::Vector2& p) const { return cos * p.y() - sin * p.x(); }
  [[nodiscard]] double along_m(const types::Vector2& p) const { return cos * p.x() + sin * p.y(); }
};

/// True when the run is long, full and dense enough to be a wall.
bool is_wall_run(std::span<const Place> places, const WallParams& params);

/// The points of one direction in lines of overlapping bins: line i holds the points of half bins i and i +
/// 1, sorted by u. A wall thinner than half a bin then lies completely in some line. Value type.
class WallLines {
 public:
  /// Consecutive points of a line without a gap that may be a wall.
  struct Stretch {
    std::size_t line;
    std::size_t first, count;  ///< among the line's points
  };

  /// At least one point. Costs a sort of the points within each half bin.
  WallLines(std::span<const types::Vector2> points, const Direction& direction, const WallParams& params);

  [[nodiscard]] std::size_t size() const { return layout_.bins; }
  /// Points of a half bin, sorted by u.
  [[nodiscard]] std::span<const Place> bin(std::size_t i) const {
    return std::span(places_).subspan(first_[i], first_[i + 1] - first_[i]);
  }
  /// A wall has one in each line that it touches.
  [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }
  [[nodiscard]] std::span<const Place> places_of(const Stretch& stretch) const {
    return std::span(merged_).subspan(start_of(stretch.line) + stretch.first, stretch.count);
  }

 private:
  /// Assignment of points to half bins.
  struct Layout {
    Direction along{1.0, 0.0};
    double low_m = 0.0, width_m = 1.0;
    std::size_t bins = 0;

    /// Signed, so that it can be vectorised.
    [[nodiscard]] std::int32_t bin(double across_m) const {
      return static_cast<std::int32_t>((across_m - low_m) / width_m);
    }
    [[nodiscard]] Place place(const types::Vector2& p) const {
      return {static_cast<float>(along.along_m(p)), static_cast<float>(along.across_m(p))};
    }
  };
  static Layout layout_of(const compass::Extent& across, std::size_t points, const Direction& direction,
                          double half_bin_m);
  void fill_bins(std::span<const types::Vector2> points);
  void sort_bins();
  void fill_lines(const WallParams& params);
  void find_stretches(std::size_t line, std::span<const Place> places, const WallParams& params);

  /// Index in `merged_` at which a line begins: the lines before it hold bin 0 and bin `line` once, and the
  /// bins between twice.
  [[nodiscard]] std::size_t start_of(std::size_t line) const {
    return first_[line] + first_[line + 1] - first_[1];
  }

  Layout layout_;
  std::vector<std::size_t> first_;  ///< index of every half bin's first place, then the end twice
  std::vector<Place> places_;       ///< bin by bin
  std::vector<Place> merged_;       ///< line by line; meaningless for lines with too few points
  std::vector<Stretch> stretches_;
};

}  // namespace topo::walls

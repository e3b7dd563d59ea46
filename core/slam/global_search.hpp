// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/place_blocks.hpp"
#include "core/slam/search.hpp"

namespace topo::slam {

/// The squares of a pyramid's window where a robot can stand, and for every level whether a square of 2^level
/// cells' side contains any. Halves the search space inside a building, and reduces it more outside.
class StandingRoom {
 public:
  static constexpr int kFinest = 3;  ///< squares of 8 cells

  explicit StandingRoom(const LikelihoodPyramid& pyramid, double width_m);

  /// Marks the squares along a free ray, and the neighbours that the ray may cross between its samples.
  void add_ray(const Point& from, const Point& to);
  /// Computes the coarser levels; called after the last ray.
  void close();

  /// True when any ground of the square is free. (x, y): lower left cell, a multiple of the side 2^level.
  [[nodiscard]] bool any(int level, int x, int y) const;
  /// Side of the window in cells.
  [[nodiscard]] int width() const { return width_; }

 private:
  void mark(int x, int y);
  int width_;
  Point origin_;
  double square_m_;
  std::vector<std::vector<char>> levels_;  ///< from kFinest on
  std::vector<int> side_;
};

/// A map's likelihood on the three levels that are searched in succession.
class PlaceLevels {
 public:
  static constexpr int kCoarse = 3, kRoot = 6;  ///< squares of 8 and of 64 cells

  /// `params.depth` is ignored: the depth is kRoot.
  PlaceLevels(const SurfelMap& map, SearchParams params);

  [[nodiscard]] const LikelihoodPyramid& pyramid() const { return pyramid_; }
  [[nodiscard]] const PlaceBlocks& fine() const { return fine_; }
  [[nodiscard]] const PlaceBlocks& coarse() const { return coarse_; }

 private:
  LikelihoodPyramid pyramid_;
  PlaceBlocks fine_, coarse_;
};

/// Which peaks a search returns.
struct PeakSearch {
  double score_min = 0.35;  ///< minimum likelihood of a peak
  double ratio = 0.80;      ///< minimum share of the best peak's likelihood
  std::size_t count_max = 5;
  double apart_m = 0.7;  ///< closer poses are one peak, of which the best counts
  double apart_rad = 0.3;
};

/// The best poses of the points over the standing room and all directions, best first, by branch and bound
/// over blocks of squares: exact on the likelihood's cells and on angle steps of one cell at
/// SearchParams::angle_reach_m. Each is
/// the best pose that is apart from all poses before it.
std::vector<SearchHit> search_everywhere(const PlaceLevels& levels, const StandingRoom& room,
                                         std::span<const Point> points, const PeakSearch& wanted,
                                         const SearchParams& params);

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/place_blocks.hpp"
#include "core/slam/search.hpp"

namespace topo::slam {

/// Squares of a pyramid's window where a robot can stand, and for every level whether one of 2^level cells'
/// side has any: halves what is searched in a building, and more outside of it.
class StandingRoom {
 public:
  static constexpr int kFinest = 3;  ///< squares of 8 cells

  explicit StandingRoom(const LikelihoodPyramid& pyramid, double width_m);

  /// Marks the squares along a free ray, and their neighbours, where the ray's samples may have passed over
  /// one.
  void add_ray(const Point& from, const Point& to);
  /// After the last ray: the coarser levels.
  void close();

  /// Is any of the square's ground free? (x, y): lower left cell, a multiple of its side 2^level.
  [[nodiscard]] bool any(int level, int x, int y) const;
  /// Cells of the window's side.
  [[nodiscard]] int width() const { return width_; }

 private:
  void mark(int x, int y);
  int width_;
  Point origin_;
  double square_m_;
  std::vector<std::vector<char>> levels_;  ///< from kFinest on
  std::vector<int> side_;
};

/// A map's likelihood on the three levels that are searched one after the other.
class PlaceLevels {
 public:
  static constexpr int kCoarse = 3, kRoot = 6;  ///< squares of 8 and of 64 cells

  /// `params.depth` is not asked: it is kRoot.
  PlaceLevels(const SurfelMap& map, SearchParams params);

  [[nodiscard]] const LikelihoodPyramid& pyramid() const { return pyramid_; }
  [[nodiscard]] const PlaceBlocks& fine() const { return fine_; }
  [[nodiscard]] const PlaceBlocks& coarse() const { return coarse_; }

 private:
  LikelihoodPyramid pyramid_;
  PlaceBlocks fine_, coarse_;
};

/// Which places are looked for.
struct PeakSearch {
  double score_min = 0.35;  ///< likelihood from which a place is one
  double ratio = 0.80;      ///< and its least share of the best one's
  std::size_t count_max = 5;
  double apart_m = 0.7;  ///< nearer poses are one place, of which the best counts
  double apart_rad = 0.3;
};

/// The best places of the points in the room and in all directions, the best first, by branch and bound over
/// blocks of squares: exact on the likelihood's cells and on angle steps of a cell at 10 m. Each is the best
/// that is apart from those before it.
std::vector<SearchHit> search_everywhere(const PlaceLevels& levels, const StandingRoom& room,
                                         std::span<const Point> points, const PeakSearch& wanted,
                                         const SearchParams& params);

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

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

/// Poses that are no answer any more.
using Exclusions = std::span<const Exclusion>;

/// The best pose of the points anywhere in the room and in any direction, by branch and bound over squares of
/// the pyramid; exact on its cells and on angle steps of a cell at 10 m. Nothing when no pose scores
/// `score_min`.
std::optional<SearchHit> search_everywhere(const LikelihoodPyramid& pyramid, const StandingRoom& room,
                                           std::span<const Point> points, double score_min,
                                           Exclusions excluded, const SearchParams& params);

}  // namespace topo::slam

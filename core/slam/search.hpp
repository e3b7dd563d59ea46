// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/slam/surfel_map.hpp"

namespace topo::slam {

/// A point's cell relative to the cell of the evaluated pose.
struct CellOffset {
  int x, y;
};

/// Half widths of a search around a pose.
struct SearchWindow {
  double half_m = 0.5;
  double half_rad = 0.2;
};

struct SearchHit {
  types::Se2 T_map_base;
  double score = 0.0;  ///< mean likelihood of the points, 0..1
};

/// Likelihood of a point over the cells of a map's window, and its max pyramid: level h holds the maximum
/// over the 2^h x 2^h cells to the upper right.
class LikelihoodPyramid {
 public:
  LikelihoodPyramid(const SurfelMap& map, const SearchParams& params);

  [[nodiscard]] int depth() const { return static_cast<int>(levels_.size()) - 1; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] const Point& origin() const { return origin_; }
  [[nodiscard]] int width() const { return width_; }  ///< cells of the window's side
  /// Zero outside.
  [[nodiscard]] std::uint8_t at(int level, int x, int y) const {
    if (static_cast<unsigned>(x) >= static_cast<unsigned>(width_) ||
        static_cast<unsigned>(y) >= static_cast<unsigned>(width_)) {
      return clipped(level, x, y);
    }
    return levels_[static_cast<std::size_t>(level)][static_cast<std::size_t>(y * width_ + x)];
  }

 private:
  [[nodiscard]] std::uint8_t clipped(int level, int x, int y) const;
  void draw(std::span<const Surfel> surfels, int reach, double sigma_m);
  void coarsen(std::size_t level);

  double cell_m_;
  Point origin_ = Point::Zero();  ///< lower left corner
  int width_ = 0;                 ///< cells along either side: the window is square
  std::vector<std::vector<std::uint8_t>> levels_;
};

/// Poses around an earlier result: a search without them finds the second peak.
struct Exclusion {
  types::Se2 centre;
  double radius_m = 0.5;
  double radius_rad = 0.2;
};

/// The best pose of the points (base_link) within the window around `centre`, by branch and bound (Hess et
/// al. 2016): exact on the grid of cells and angle steps. Empty when no pose scores at least `score_min`.
std::optional<SearchHit> search(const LikelihoodPyramid& pyramid, std::span<const Point> points,
                                const types::Se2& centre, const SearchWindow& window, double score_min,
                                const SearchParams& params, const std::optional<Exclusion>& exclusion = {});

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/grid/distance.hpp"
#include "core/grid/near_squares.hpp"
#include "core/types/invariant.hpp"

namespace topo::grid {

// The first pass computes distances along the columns, for whole rows in vector instructions; the second
// computes, along the rows, the lower envelope of parabolas over them (Meijster et al. 2000). It skips blocks
// of boundary cells, and builds the envelope only for runs with cells far from boundary: columns beyond a
// boundary cell of the row are farther away than that cell.

/// Distance along the column to the next boundary cell on one side, for one row from the row beside it. A
/// mask replaces the branch, so that the compiler vectorises the loop.
template <Boundary kBoundary>
void steps_on(const CellState* cells, const Steps* beside, Steps* out, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x) {
    const bool open =
        kBoundary == Boundary::kOccupied ? cells[x] != CellState::kOccupied : cells[x] == CellState::kFree;
    const auto mask = static_cast<Steps>(-static_cast<Steps>(open));
    const auto next = static_cast<Steps>(beside[x] + 1);
    out[x] = static_cast<Steps>(std::min(next, kNone) & mask);
  }
}

/// Distance to the nearest boundary cell on either side: `row` has the distance on one side, `beside` is the
/// finished row on the other.
inline void steps_back(const Steps* beside, Steps* row, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x) row[x] = std::min(row[x], static_cast<Steps>(beside[x] + 1));
}

/// Lower envelope of the parabolas over one run. A boundary cell may lie just outside each end.
class RunEnvelope {
 public:
  explicit RunEnvelope(std::size_t width) : sites_(width + 2) {}

  /// Writes the squared distances of the cells [first, end) of a row to `out`.
  void run(const Steps* row, int first, int end, bool wall_before, bool wall_after, std::int32_t* out) {
    size_ = 0;
    if (wall_before) add(first - 1, 0, first, end);
    for (int x = first; x < end; ++x)
      if (row[x] < kNone) add(x, row[x], first, end);
    if (wall_after) add(end, 0, first, end);
    evaluate(first, end, out);
  }

 private:
  struct Site {
    int x;
    std::int32_t square;  ///< of the distance along the column
    int from;             ///< first cell of the run to which this site is nearest
  };

  static std::int32_t square_at(const Site& site, int x) { return (x - site.x) * (x - site.x) + site.square; }

  /// Adds a site to the right of all sites before it.
  void add(int x, int steps, int first, int end) {
    Site site{x, steps * steps, first};
    while (size_ > 0) {
      const Site& top = sites_[size_ - 1];
      const std::int32_t farther = square_at(site, top.from) - square_at(top, top.from);
      if (farther >= 0) {
        // With every cell to the right the difference falls by twice the distance between the sites. Most
        // sites are adjacent, and a division costs more than the rest of the loop.
        const int apart = site.x - top.x;
        const std::int32_t cells = (apart == 1 ? farther >> 1 : farther / (2 * apart)) + 1;
        if (cells >= end - top.from) return;
        site.from = top.from + cells;
        break;
      }
      --size_;
    }
    types::require(size_ < sites_.size(), "grid::RunEnvelope: more sites than columns");
    sites_[size_++] = site;
  }

  void evaluate(int first, int end, std::int32_t* out) const {
    if (size_ == 0) {
      std::fill(out + first, out + end, std::numeric_limits<std::int32_t>::max());
      return;
    }
    int stop = end;
    for (std::size_t i = size_; i-- > 0;) {
      for (int x = sites_[i].from; x < stop; ++x) out[x] = square_at(sites_[i], x);
      stop = sites_[i].from;
    }
  }

  std::vector<Site> sites_;
  std::size_t size_ = 0;
};

/// Computes the distances of one row from the column distances.
class RowPass {
 public:
  RowPass(std::size_t width, double resolution_m, bool open_outside)
      : width_(static_cast<int>(width)),
        resolution_m_(static_cast<float>(resolution_m)),
        open_outside_(open_outside),
        near_(width, open_outside),
        envelope_(width),
        squares_(width) {}

  /// Writes the distances of the cells [from, end) of a row. Precondition: `out` is zero there.
  void cells(const Steps* row, int from, int end, float* out) {
    far_end_ = 0;
    bool is_taken = false;
    for (int x = from; x < end; x += kBlock) {
      const int block_end = std::min(x + kBlock, end);
      if (is_boundary(row, x, block_end)) continue;  // as most blocks of a map are
      if (!is_taken) near_.take(row, static_cast<std::size_t>(x), static_cast<std::size_t>(end));
      is_taken = true;
      const NearSquares::Block squares = near_.of_block(static_cast<std::size_t>(x));
      metres(squares.data(), block_end - x, out + x);
      if (NearSquares::greatest(squares) < NearSquares::kFar) continue;
      for (int i = x; i < block_end; ++i)
        if (squares[static_cast<std::size_t>(i - x)] >= NearSquares::kFar) far_cell(row, i, out);
    }
  }

 private:
  static constexpr int kBlock = NearSquares::kBlock;

  static bool is_boundary(const Steps* row, int from, int end) {
    Steps any = 0;
    for (int x = from; x < end; ++x) any |= row[x];
    return any == 0;
  }
  /// Distance of a cell far from all boundary, from the envelope of its run. Far cells come in ascending
  /// order.
  void far_cell(const Steps* row, int x, float* out) {
    if (x >= far_end_) {
      int first = x;
      while (first > 0 && row[first - 1] != 0) --first;
      for (far_end_ = x + 1; far_end_ < width_ && row[far_end_] != 0;) ++far_end_;
      const bool wall_before = first > 0 || !open_outside_, wall_after = far_end_ < width_ || !open_outside_;
      envelope_.run(row, first, far_end_, wall_before, wall_after, squares_.data());
    }
    const std::int32_t square = squares_[static_cast<std::size_t>(x)];
    if (square == std::numeric_limits<std::int32_t>::max())
      out[x] = std::numeric_limits<float>::infinity();
    else
      metres(&square, 1, out + x);
  }
  template <class T>
  void metres(const T* squares, int count, float* out) const {
    const float resolution_m = resolution_m_;  // local copy: writes to `out` cannot change it
    for (int i = 0; i < count; ++i) out[i] = resolution_m * std::sqrt(static_cast<float>(squares[i]));
  }

  int width_;
  float resolution_m_;
  bool open_outside_;
  NearSquares near_;
  RunEnvelope envelope_;
  std::vector<std::int32_t> squares_;  ///< of the last run of far cells
  int far_end_ = 0;                    ///< end of that run
};

}  // namespace topo::grid

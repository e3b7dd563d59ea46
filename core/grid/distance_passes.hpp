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

// First distances along the columns, then along the rows the lower envelope of parabolas over them (Meijster
// et al. 2000). The first goes over whole rows, cell by cell in vector instructions; the second only where
// there are cells that are not boundary, and only over runs of those that are far from it: no boundary cell
// sees past another one in its row.

/// Distance to the next boundary on one side along the column: one row from the row beside it. A mask in
/// place of a branch, so that the compiler makes vector instructions of it.
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

/// To the nearest one: `row` has the distance on one side, `beside` is the row on the other, done already.
inline void steps_back(const Steps* beside, Steps* row, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x) row[x] = std::min(row[x], static_cast<Steps>(beside[x] + 1));
}

/// Lower envelope of the parabolas over one run, whose ends may have a boundary cell just outside.
class RunEnvelope {
 public:
  explicit RunEnvelope(std::size_t width) : sites_(width + 2) {}

  /// Squared distances of the cells [first, end) of a row to out.
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
    std::int32_t square;  ///< of its distance along the column
    int from;             ///< first cell of the run for which it is the nearest
  };

  static std::int32_t square_at(const Site& site, int x) { return (x - site.x) * (x - site.x) + site.square; }

  /// A site to the right of all before it.
  void add(int x, int steps, int first, int end) {
    Site site{x, steps * steps, first};
    while (size_ > 0) {
      const Site& top = sites_[size_ - 1];
      const std::int32_t farther = square_at(site, top.from) - square_at(top, top.from);
      if (farther >= 0) {
        // With every cell to the right the difference falls by twice the distance of the sites; mostly they
        // are neighbours, and a division costs more than the rest of the loop.
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

/// Distances of one row from those along the columns.
class RowPass {
 public:
  RowPass(std::size_t width, double resolution_m, bool open_outside)
      : width_(static_cast<int>(width)),
        resolution_m_(static_cast<float>(resolution_m)),
        open_outside_(open_outside),
        near_(width, open_outside),
        envelope_(width),
        squares_(width) {}

  /// Of the cells [from, end) of a row; `out` is zero so far.
  void cells(const Steps* row, int from, int end, float* out) {
    far_end_ = 0;
    bool is_taken = false;
    for (int x = from; x < end; x += kBlock) {
      const int block_end = std::min(x + kBlock, end);
      if (is_boundary(row, x, block_end)) continue;  // most of a map is
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
  /// What is far from all boundary, by its run: far cells come in rising order.
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
    const float resolution_m = resolution_m_;  // a copy, which writing to out cannot change
    for (int i = 0; i < count; ++i) out[i] = resolution_m * std::sqrt(static_cast<float>(squares[i]));
  }

  int width_;
  float resolution_m_;
  bool open_outside_;
  NearSquares near_;
  RunEnvelope envelope_;
  std::vector<std::int32_t> squares_;  ///< of the run of far cells looked at last
  int far_end_ = 0;                    ///< its end
};

}  // namespace topo::grid

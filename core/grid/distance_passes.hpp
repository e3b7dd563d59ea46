// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "core/grid/distance.hpp"

namespace topo::grid {

// First distances along the columns, then along the rows the lower envelope of parabolas over them (Meijster
// et al. 2000). The first goes over whole rows, cell by cell in vector instructions; the second only over
// runs of cells that are not boundary: no boundary cell sees past another one in its row.

/// Distance along the column, in cells; kNone where the column has no boundary. The maximum of 16 signed bits
/// less one, so that one more fits: SSE2, which every amd64 machine has, knows the minimum of signed ones
/// only. Squares of distances and their sums then fit 32 bits.
using Steps = std::int16_t;
inline constexpr Steps kNone = 32766;

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
        envelope_(width),
        squares_(width) {}

  /// Of the cells [from, end), beside which there is boundary or the end of the row; `out` is zero so far.
  void cells(const Steps* steps, int from, int end, float* out) {
    for (int x = from; x < end;) {
      x = skip_boundary(steps, x, end);
      const int first = x;
      while (x < end && steps[x] != 0) ++x;
      if (first == x) break;
      const bool wall_before = first > 0 || !open_outside_, wall_after = x < width_ || !open_outside_;
      envelope_.run(steps, first, x, wall_before, wall_after, squares_.data());
      metres(first, x, out);
    }
  }

  /// Of cells [from, end), none of which is boundary, by what is there and the walls beside them.
  void open_cells(const Steps* steps, int from, int end, bool wall_before, bool wall_after, float* out) {
    envelope_.run(steps, from, end, wall_before, wall_after, squares_.data());
    metres(from, end, out);
  }

 private:
  /// From `x` on the first cell that is not boundary, or the end. Most of a map is boundary.
  static int skip_boundary(const Steps* steps, int x, int end) {
    constexpr int kAtOnce = sizeof(std::uint64_t) / sizeof(Steps);
    for (std::uint64_t several = 0; x + kAtOnce <= end; x += kAtOnce) {
      std::memcpy(&several, steps + x, sizeof several);
      if (several != 0) break;
    }
    while (x < end && steps[x] == 0) ++x;
    return x;
  }
  void metres(int first, int end, float* out) const {
    constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
    const float resolution_m = resolution_m_;  // a copy, which writing to out cannot change
    const std::int32_t* const squares = squares_.data();
    for (int x = first; x < end; ++x) {
      const float distance_m = resolution_m * std::sqrt(static_cast<float>(squares[x]));
      out[x] = squares[x] == kFar ? std::numeric_limits<float>::infinity() : distance_m;
    }
  }

  int width_;
  float resolution_m_;
  bool open_outside_;
  RunEnvelope envelope_;
  std::vector<std::int32_t> squares_;
};

}  // namespace topo::grid

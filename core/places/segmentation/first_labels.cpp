// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/first_labels.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/grid/free_runs.hpp"
#include "core/places/segmentation/ascent.hpp"
#include "core/places/segmentation/slopes.hpp"
#include "core/places/skeleton/fetch_ahead.hpp"

namespace topo::places {
namespace {

using grid::DenseMap;

/// Positions of the narrowest cells between wider parts of an edge, including the nodes at both ends.
void find_passages(std::span<const std::uint32_t> cells, std::span<const float> clearance_m, float at_a_m,
                   float at_b_m, float passage_ratio, std::vector<std::size_t>& passages) {
  passages.clear();
  float widest = at_a_m, narrowest = at_a_m;
  std::size_t where = 0;
  for (std::size_t k = 0; k <= cells.size(); ++k) {
    const float here = k < cells.size() ? clearance_m[cells[k]] : at_b_m;
    if (here < narrowest && k < cells.size()) {
      narrowest = here;
      where = k;
    }
    if (narrowest * passage_ratio < widest && here > narrowest * passage_ratio) {
      passages.push_back(where);
      widest = narrowest = here;
    } else if (here > widest) {
      widest = narrowest = here;
    }
  }
}

/// Divides the axis into pieces. Every cell, in the order of Skeleton::axis, has the number of its piece.
class AxisPieces {
 public:
  AxisPieces(const DenseMap& map, std::span<const float> clearance_m, const Skeleton& skeleton,
             const FirstLabelParams& params)
      : skeleton_(skeleton),
        clearance_m_(clearance_m),
        passage_ratio_(params.passage_ratio),
        numbers_(skeleton.axis.size(), 0) {
    piece_cells_ =
        std::max<std::size_t>(static_cast<std::size_t>(std::lround(params.piece_m / map.resolution_m)), 1);
    count_ = static_cast<std::uint32_t>(skeleton_.nodes.size());
    for (std::uint32_t n = 0; n < skeleton_.nodes.size(); ++n) {
      const SkeletonNode& node = skeleton_.nodes[n];
      std::fill_n(numbers_.begin() + node.first_cell, node.cell_count, n);
    }
    for (const SkeletonEdge& edge : skeleton_.edges) divide_edge(edge);
  }

  /// The labels of the pieces.
  [[nodiscard]] std::vector<std::uint32_t> labels() const {
    std::vector<std::uint32_t> lowest(count_, kLost);
    for (std::size_t k = 0; k < numbers_.size(); ++k)
      lowest[numbers_[k]] = std::min(lowest[numbers_[k]], skeleton_.axis[k] + 1);
    return lowest;
  }
  [[nodiscard]] const std::vector<std::uint32_t>& numbers() const { return numbers_; }

 private:
  void divide_edge(const SkeletonEdge& edge) {
    const auto cells = skeleton_.cells_of(edge);
    find_passages(cells, clearance_m_, skeleton_.nodes[edge.a].clearance_m,
                  skeleton_.nodes[edge.b].clearance_m, passage_ratio_, passages_);
    std::size_t begin = 0;
    for (std::size_t p = 0; p <= passages_.size(); ++p) {
      const bool last = p == passages_.size();
      const std::size_t end = last ? cells.size() : passages_[p];
      const std::span stretch = std::span(numbers_).subspan(edge.first_cell + begin, end - begin);
      divide_stretch(stretch, p == 0 ? std::optional(edge.a) : std::nullopt,
                     last ? std::optional(edge.b) : std::nullopt);
      begin = end;
    }
  }

  /// Divides cells into pieces of equal length; the first and the last belong to the nodes `a` and `b`.
  void divide_stretch(std::span<std::uint32_t> cells, std::optional<std::uint32_t> a,
                      std::optional<std::uint32_t> b) {
    const std::size_t least = a && b ? 2 : 1;
    const std::size_t count = std::max(least, (cells.size() + piece_cells_ / 2) / piece_cells_);
    for (std::size_t piece = 0; piece < count; ++piece) {
      const std::size_t begin = piece * cells.size() / count, end = (piece + 1) * cells.size() / count;
      if (begin == end) continue;
      const bool to_a = piece == 0 && a, to_b = piece + 1 == count && b;
      const std::uint32_t number = to_a ? *a : to_b ? *b : count_++;
      std::fill(cells.begin() + static_cast<std::ptrdiff_t>(begin),
                cells.begin() + static_cast<std::ptrdiff_t>(end), number);
    }
  }

  const Skeleton& skeleton_;
  std::span<const float> clearance_m_;
  float passage_ratio_;
  std::size_t piece_cells_ = 1;
  std::uint32_t count_ = 0;
  std::vector<std::uint32_t> numbers_;
  std::vector<std::size_t> passages_;
};

/// Spreads labels from the cells in `queue` over all connected open cells (eight neighbours), breadth first.
void spread(std::span<const std::ptrdiff_t> offsets, std::span<const Slope> slopes,
            std::vector<std::uint32_t>& labels, std::vector<std::uint32_t>& queue) {
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const auto i = static_cast<std::ptrdiff_t>(queue[next]);
    const std::uint32_t label = labels[queue[next]];
    for (const std::ptrdiff_t offset : offsets) {
      const auto j = static_cast<std::size_t>(i + offset);
      if (slopes[j] == kClosed || labels[j] != 0) continue;
      labels[j] = label;
      queue.push_back(static_cast<std::uint32_t>(j));
    }
  }
}

/// Labelled cells with one of the given cells as a neighbour, ascending.
std::vector<std::uint32_t> labelled_beside(std::span<const std::ptrdiff_t> offsets,
                                           std::span<const std::uint32_t> cells,
                                           const std::vector<std::uint32_t>& labels) {
  std::vector<std::uint32_t> beside;
  for (const std::uint32_t i : cells) {
    for (const std::ptrdiff_t offset : offsets) {
      const auto j = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offset);
      if (labels[j] != 0) beside.push_back(j);
    }
  }
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  return beside;
}

/// Gives cells whose ascent does not lead to the axis the label of the nearest labelled cell.
void label_lost(const DenseMap& map, std::span<const Slope> slopes, std::span<const std::uint32_t> lost,
                std::vector<std::uint32_t>& labels) {
  for (const std::uint32_t i : lost) labels[i] = 0;
  const auto offsets = neighbour_offsets(map);
  std::vector<std::uint32_t> queue = labelled_beside(offsets, lost, labels);
  spread(offsets, slopes, labels, queue);
}

/// Labels the axis.
void label_axis(const Skeleton& skeleton, const AxisPieces& pieces, FirstLabels& first) {
  first.axis = skeleton.axis;
  first.pieces = pieces.labels();
  first.axis_pieces = pieces.numbers();
  for (std::size_t k = 0; k < first.axis.size(); ++k) {
    fetch_ahead(first.labels.data(), first.axis, k);
    first.labels[first.axis[k]] = first.pieces[first.axis_pieces[k]];
  }
}

void number_runs(FirstLabels& first, std::size_t cells) {
  const PieceNumbers numbers(first, cells);
  first.run_pieces.resize(first.runs.size());
  for (std::size_t k = 0; k < first.runs.size(); ++k) first.run_pieces[k] = numbers.of(first.runs[k].label);
}

}  // namespace

FirstLabels first_labels(const DenseMap& map, std::span<const float> clearance_m, const Skeleton& skeleton,
                         const FirstLabelParams& params) {
  FirstLabels first;
  first.box = map.box;
  first.labels.resize(map.cells.size(), 0);
  if (map.cells.empty()) return first;
  label_axis(skeleton, {map, clearance_m, skeleton, params}, first);
  const std::vector<Slope> slopes = slopes_of(map, clearance_m);
  Ascent ascent(map, slopes, first.labels);
  grid::for_each_free_run(map, [&](const grid::FreeRun& run) {
    for (std::size_t i = run.first; i < run.end; ++i)
      if (slopes[i] != kClosed) ascent.climb(static_cast<std::uint32_t>(i));
  });
  label_lost(map, slopes, ascent.lost(), first.labels);
  first.runs = piece_runs(map, clearance_m, first.labels);
  number_runs(first, map.cells.size());
  return first;
}

}  // namespace topo::places

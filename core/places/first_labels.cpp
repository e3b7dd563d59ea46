// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/first_labels.hpp"

#include <algorithm>
#include <cmath>

#include "core/places/ascent.hpp"
#include "core/places/thinning.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

/// Clearance must fall and rise again by this factor for a passage.
constexpr float kPassageRatio = 1.3F;

/// Positions along an edge of its narrowest cells between wider parts, the nodes at both ends included.
void find_passages(std::span<const std::uint32_t> cells, std::span<const float> clearance_m, float at_a_m,
                   float at_b_m, std::vector<std::size_t>& passages) {
  passages.clear();
  float widest = at_a_m, narrowest = at_a_m;
  std::size_t where = 0;
  for (std::size_t k = 0; k <= cells.size(); ++k) {
    const float here = k < cells.size() ? clearance_m[cells[k]] : at_b_m;
    if (here < narrowest && k < cells.size()) {
      narrowest = here;
      where = k;
    }
    if (narrowest * kPassageRatio < widest && here > narrowest * kPassageRatio) {
      passages.push_back(where);
      widest = narrowest = here;
    } else if (here > widest) {
      widest = narrowest = here;
    }
  }
}

/// Hands out labels of pieces to the cells of the axis.
class AxisLabels {
 public:
  AxisLabels(const DenseMap& map, std::span<const float> clearance_m, const Skeleton& skeleton,
             double piece_m, std::vector<std::uint32_t>& labels)
      : skeleton_(skeleton), clearance_m_(clearance_m), labels_(labels) {
    piece_cells_ =
        std::max<std::size_t>(static_cast<std::size_t>(std::lround(piece_m / map.resolution_m)), 1);
  }

  std::uint32_t give() {
    pieces_ = static_cast<std::uint32_t>(skeleton_.nodes.size());
    for (std::uint32_t n = 0; n < skeleton_.nodes.size(); ++n) {
      for (const std::uint32_t i : skeleton_.cells_of(skeleton_.nodes[n])) labels_[i] = n + 1;
    }
    for (const SkeletonEdge& edge : skeleton_.edges) label_edge(edge);
    return pieces_;
  }

 private:
  void label_edge(const SkeletonEdge& edge) {
    const auto cells = skeleton_.cells_of(edge);
    find_passages(cells, clearance_m_, skeleton_.nodes[edge.a].clearance_m,
                  skeleton_.nodes[edge.b].clearance_m, passages_);
    std::size_t begin = 0;
    for (std::size_t p = 0; p <= passages_.size(); ++p) {
      const bool last = p == passages_.size();
      const std::size_t end = last ? cells.size() : passages_[p];
      label_stretch(cells.subspan(begin, end - begin), p == 0 ? edge.a + 1 : 0, last ? edge.b + 1 : 0);
      begin = end;
    }
  }

  /// Even pieces; the first and the last go to the nodes `a` and `b` (labels, 0: there is none).
  void label_stretch(std::span<const std::uint32_t> cells, std::uint32_t a, std::uint32_t b) {
    const std::size_t least = a != 0 && b != 0 ? 2 : 1;
    const std::size_t count = std::max(least, (cells.size() + piece_cells_ / 2) / piece_cells_);
    for (std::size_t piece = 0; piece < count; ++piece) {
      const std::size_t begin = piece * cells.size() / count, end = (piece + 1) * cells.size() / count;
      if (begin == end) continue;
      const bool to_a = piece == 0 && a != 0, to_b = piece + 1 == count && b != 0;
      const std::uint32_t label = to_a ? a : to_b ? b : ++pieces_;
      for (const std::uint32_t i : cells.subspan(begin, end - begin)) labels_[i] = label;
    }
  }

  const Skeleton& skeleton_;
  std::span<const float> clearance_m_;
  std::vector<std::uint32_t>& labels_;
  std::size_t piece_cells_;
  std::uint32_t pieces_ = 0;
  std::vector<std::size_t> passages_;
};

/// Spreads labels from the cells in `queue` over free cells, breadth first over the given neighbours.
void spread(const DenseMap& map, std::span<const std::ptrdiff_t> offsets, std::vector<std::uint32_t>& labels,
            std::vector<std::uint32_t>& queue) {
  const CellState* cells = map.cells.data();
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const auto i = static_cast<std::ptrdiff_t>(queue[next]);
    const std::uint32_t label = labels[queue[next]];
    for (const std::ptrdiff_t offset : offsets) {
      const auto j = static_cast<std::size_t>(i + offset);
      if (cells[j] != CellState::kFree || labels[j] != 0) continue;
      labels[j] = label;
      queue.push_back(static_cast<std::uint32_t>(j));
    }
  }
}

constexpr std::uint32_t kBarred = UINT32_MAX;

/// Sets the array's outermost cells: what spreads need not ask where the array ends.
void bar_border(const DenseMap& map, std::uint32_t label, std::vector<std::uint32_t>& labels) {
  const auto width = static_cast<std::size_t>(map.width()), height = static_cast<std::size_t>(map.height());
  for (std::size_t x = 0; x < width; ++x) labels[x] = labels[(height - 1) * width + x] = label;
  for (std::size_t y = 0; y < height; ++y) labels[y * width] = labels[y * width + width - 1] = label;
}

/// Cells with a label that have one of the given cells as a neighbour, ascending.
std::vector<std::uint32_t> labelled_beside(const DenseMap& map, std::span<const std::uint32_t> cells,
                                           const std::vector<std::uint32_t>& labels) {
  std::vector<std::uint32_t> beside;
  for (const std::uint32_t i : cells) {
    for (const std::ptrdiff_t offset : neighbour_offsets(map)) {
      const auto j = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offset);
      if (labels[j] != 0 && labels[j] != kBarred) beside.push_back(j);
    }
  }
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  return beside;
}

}  // namespace

FirstLabels first_labels(const DenseMap& map, std::span<const float> clearance_m, const Skeleton& skeleton,
                         double piece_m) {
  FirstLabels first{std::vector<std::uint32_t>(map.cells.size(), 0), 0};
  if (map.cells.empty()) return first;
  first.pieces = AxisLabels(map, clearance_m, skeleton, piece_m, first.labels).give();
  const std::vector<std::uint32_t> lost = climb_to_labels(map, clearance_m, first.labels);
  if (lost.empty()) return first;
  bar_border(map, kBarred, first.labels);
  std::vector<std::uint32_t> queue = labelled_beside(map, lost, first.labels);
  spread(map, neighbour_offsets(map), first.labels, queue);
  bar_border(map, 0, first.labels);
  return first;
}

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/outlines.hpp"

#include <array>

namespace topo::daemon {
namespace {

using grid::CellIndex;

/// Walks along the sides of cells with the label on the left hand.
class Walker {
 public:
  Walker(const grid::DenseMap& map, std::span<const std::uint16_t> labels)
      : map_(map), labels_(labels), seen_(labels.size(), false) {}

  /// Is the lower side of this cell part of a boundary that no ring has yet?
  [[nodiscard]] bool starts_at(std::size_t i) const {
    return labels_[i] != 0 && !seen_[i] && labels_[i - static_cast<std::size_t>(map_.width())] != labels_[i];
  }

  /// The ring that goes east along the lower side of this cell.
  Ring walk(std::size_t start) {
    label_ = labels_[start];
    const CellIndex first = map_.cell(start);
    CellIndex at = first;
    int heading = kEast;
    Ring ring;
    do {
      if (heading == kEast) seen_[map_.index(at)] = true;
      const CellIndex step = kStep[static_cast<std::size_t>(heading)];
      at = {at.x + step.x, at.y + step.y};
      const int next = turn(at, heading);
      if (next != heading) ring.push_back(at);
      heading = next;
    } while (!(at == first && heading == kEast));
    return ring;
  }

 private:
  enum : int { kEast, kNorth, kWest, kSouth };
  static constexpr std::array<CellIndex, 4> kStep = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  /// The cell that has the corner on its own lower left, lower right, upper right, upper left: what lies to
  /// the left ahead when heading east, north, west, south.
  static constexpr std::array<CellIndex, 4> kLeftAhead = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};

  [[nodiscard]] bool in(CellIndex corner, int heading) const {
    const CellIndex by = kLeftAhead[static_cast<std::size_t>(heading)];
    const CellIndex cell{corner.x + by.x, corner.y + by.y};
    return map_.contains(cell) && labels_[map_.index(cell)] == label_;
  }
  /// Right first: cells that touch over a corner belong together.
  [[nodiscard]] int turn(CellIndex corner, int heading) const {
    const int right = (heading + 3) % 4;
    if (in(corner, right)) return right;
    return in(corner, heading) ? heading : (heading + 1) % 4;
  }

  const grid::DenseMap& map_;
  std::span<const std::uint16_t> labels_;
  std::vector<bool> seen_;  ///< lower sides
  std::uint16_t label_ = 0;
};

}  // namespace

std::vector<std::vector<Ring>> outlines_of(const grid::DenseMap& map, std::span<const std::uint16_t> labels,
                                           std::size_t label_count) {
  std::vector<std::vector<Ring>> rings(label_count);
  Walker walker(map, labels);
  // From below: the first ring of a label that is met is its outer one.
  for (auto i = static_cast<std::size_t>(map.width()); i < labels.size(); ++i) {
    if (walker.starts_at(i)) rings[labels[i] - 1U].push_back(walker.walk(i));
  }
  return rings;
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/outlines.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace topo::daemon {
namespace {

using grid::CellIndex;

/// Follows the sides of cells with the label on the left.
class Walker {
 public:
  Walker(const grid::DenseMap& map, std::span<const std::uint16_t> labels)
      : map_(map), labels_(labels), seen_(labels.size(), false) {}

  /// True when the lower side of this cell is part of a boundary that no ring contains yet.
  [[nodiscard]] bool starts_at(std::size_t i) const {
    return labels_[i] != 0 && !seen_[i] && labels_[i - static_cast<std::size_t>(map_.width())] != labels_[i];
  }

  /// The ring that runs east along the lower side of this cell.
  Ring walk(std::size_t start) {
    label_ = labels_[start];
    const CellIndex first = map_.cell(start);
    CellIndex at = first;
    int heading = kEast;
    Ring ring;
    do {
      if (heading == kEast) seen_[map_.index(at)] = true;
      const CellIndex step = grid::kSideSteps[static_cast<std::size_t>(heading)];
      at = {at.x + step.x, at.y + step.y};
      const int next = turn(at, heading);
      if (next != heading) ring.push_back(at);
      heading = next;
    } while (!(at == first && heading == kEast));
    return ring;
  }

 private:
  enum : int { kEast, kNorth, kWest, kSouth };
  /// Offset from a corner to the cell ahead on the left, when heading east, north, west, south: the cell
  /// whose lower left, lower right, upper right or upper left corner it is.
  static constexpr std::array<CellIndex, 4> kLeftAhead = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};

  [[nodiscard]] bool in(CellIndex corner, int heading) const {
    const CellIndex by = kLeftAhead[static_cast<std::size_t>(heading)];
    const CellIndex cell{corner.x + by.x, corner.y + by.y};
    return map_.contains(cell) && labels_[map_.index(cell)] == label_;
  }
  /// Prefers a left turn: cells that touch at a corner alone are parted.
  [[nodiscard]] int turn(CellIndex corner, int heading) const {
    const int left = (heading + 1) % 4, right = (heading + 3) % 4;
    if (!in(corner, heading)) return left;
    return in(corner, right) ? right : heading;
  }

  const grid::DenseMap& map_;
  std::span<const std::uint16_t> labels_;
  std::vector<bool> seen_;  ///< lower sides that a ring contains
  std::uint16_t label_ = 0;
};

/// Parts a ring at the corners that it meets twice: what is cut off is a ring of its own, which touches the
/// rest there. Polygons whose rings touch themselves are invalid (OGC Simple Features, 6.1.11).
void add_simple_rings(const Ring& ring, std::vector<Ring>& out) {
  Ring open;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> place;
  for (const CellIndex& corner : ring) {
    const auto [met, fresh] = place.emplace(std::pair(corner.x, corner.y), open.size());
    if (!fresh) {
      const auto begin = open.begin() + static_cast<std::ptrdiff_t>(met->second);
      out.emplace_back(begin, open.end());
      for (auto gone = begin + 1; gone != open.end(); ++gone) place.erase({gone->x, gone->y});
      open.erase(begin + 1, open.end());
    } else {
      open.push_back(corner);
    }
  }
  out.push_back(std::move(open));
}

/// Calls f(from, to) for the sides of a ring.
template <class F>
void for_each_side(const Ring& ring, F&& f) {
  for (std::size_t k = 0; k < ring.size(); ++k) f(ring[k], ring[(k + 1) % ring.size()]);
}

/// Twice the area: positive when counter-clockwise.
std::int64_t signed_area(const Ring& ring) {
  std::int64_t twice = 0;
  for_each_side(ring, [&](const CellIndex& a, const CellIndex& b) {
    twice += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
  });
  return twice;
}

/// The left end of the lower side of a cell on the ring.
CellIndex a_lower_side(const Ring& ring) {
  CellIndex found;
  for_each_side(ring, [&](const CellIndex& a, const CellIndex& b) {
    if (a.y == b.y) found = {std::min(a.x, b.x), a.y};
  });
  return found;
}

/// True when `outer` encloses the ring with this side. Rings do not share sides, so one ring lies inside
/// another when any of its sides does.
bool encloses(const Ring& outer, const CellIndex& side) {
  int above = 0;
  for_each_side(outer, [&](const CellIndex& a, const CellIndex& b) {
    const bool over =
        a.y == b.y && a.y > side.y && std::min(a.x, b.x) <= side.x && side.x < std::max(a.x, b.x);
    above += over ? 1 : 0;
  });
  return above % 2 == 1;
}

}  // namespace

std::vector<std::vector<Ring>> parts_of(std::vector<Ring> rings) {
  std::stable_sort(rings.begin(), rings.end(),
                   [](const Ring& a, const Ring& b) { return signed_area(a) > signed_area(b); });
  const auto holes =
      std::find_if(rings.begin(), rings.end(), [](const Ring& r) { return signed_area(r) < 0; });
  std::vector<std::vector<Ring>> parts;
  for (auto outer = rings.begin(); outer != holes; ++outer) parts.push_back({std::move(*outer)});
  for (auto hole = holes; hole != rings.end(); ++hole) {
    // A part may lie in a hole of another: the smallest enclosing part is chosen.
    const auto part = std::find_if(parts.rbegin(), parts.rend(), [&](const std::vector<Ring>& p) {
      return encloses(p.front(), a_lower_side(*hole));
    });
    if (part != parts.rend()) part->push_back(std::move(*hole));
  }
  return parts;
}

std::vector<std::vector<Ring>> outlines_of(const grid::DenseMap& map, std::span<const std::uint16_t> labels,
                                           std::size_t label_count) {
  std::vector<std::vector<Ring>> rings(label_count);
  Walker walker(map, labels);
  for (auto i = static_cast<std::size_t>(map.width()); i < labels.size(); ++i) {
    if (walker.starts_at(i)) add_simple_rings(walker.walk(i), rings[labels[i] - 1U]);
  }
  return rings;
}

}  // namespace topo::daemon

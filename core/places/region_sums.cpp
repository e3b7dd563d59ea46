// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numbers>

#include "core/places/fetch_ahead.hpp"
#include "core/places/regions.hpp"

namespace topo::places {
namespace {

using grid::DenseMap;

/// What lies between regions, summed up as it is found.
class Borders {
 public:
  explicit Borders(std::size_t regions) : of_lower_(regions) {}

  /// That between two regions; `other` is of no meaning.
  Contact& between(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    std::vector<Contact>& contacts = of_lower_[low];
    const auto known = std::find_if(contacts.rbegin(), contacts.rend(),
                                    [high = high](const Contact& c) { return c.other == high; });
    if (known != contacts.rend()) return *known;
    Contact& contact = contacts.emplace_back();
    contact.other = high;
    return contact;
  }

  /// To both sides, in the order of the others' numbers.
  void hand_out(std::vector<Region>& regions) {
    for (std::uint32_t low = 0; low < regions.size(); ++low) {
      std::vector<Contact>& contacts = of_lower_[low];
      std::sort(contacts.begin(), contacts.end(),
                [](const Contact& a, const Contact& b) { return a.other < b.other; });
      for (Contact& contact : contacts) {
        contact.open = static_cast<float>(contact.border());
        regions[low].contacts.push_back(contact);
        regions[contact.other].contacts.push_back(contact);
        regions[contact.other].contacts.back().other = low;
      }
    }
  }

 private:
  std::vector<std::vector<Contact>> of_lower_;  ///< of each pair of regions at the one with the lower number
};

/// Sums over the regions' cells.
class CellSums {
 public:
  CellSums(const DenseMap& map, std::span<const float> clearance_m, const CompassFrame& frame,
           const PieceNumbers& numbers, std::vector<Region>& regions, Borders& borders)
      : map_(map),
        clearance_m_(clearance_m),
        frame_(frame),
        numbers_(numbers),
        regions_(regions),
        borders_(borders) {}

  void add(std::span<const PieceRun> runs) {
    const auto width = static_cast<std::uint32_t>(map_.width());
    std::size_t above = 0;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const PieceRun& run = runs[k];
      add_run(run);
      if (k + 1 < runs.size() && runs[k + 1].first == run.end) note_upright(run, runs[k + 1]);
      while (above < runs.size() && runs[above].end <= run.first + width) ++above;
      for (std::size_t a = above; a < runs.size() && runs[a].first < run.end + width; ++a)
        if (runs[a].label != run.label) note_level(run, runs[a], width);
    }
    pad_boxes();
  }

 private:
  void add_run(const PieceRun& run) {
    Region& region = regions_[numbers_.of(run.label)];
    const std::uint32_t count = run.end - run.first;
    const types::Vector2 a = map_.centre_of(map_.cell(run.first));
    const types::Vector2 b = a + types::Vector2(static_cast<double>(count - 1) * map_.resolution_m, 0.0);
    region.box.extend(frame_.from_map(a));
    region.box.extend(frame_.from_map(b));
    region.sum += 0.5 * static_cast<double>(count) * (a + b);
    region.cells += count;
    region.first = std::min(region.first, run.first);
    region.clearance_m = std::max(region.clearance_m, run.clearance_m);
  }
  void note_upright(const PieceRun& run, const PieceRun& next) {
    Contact& contact = borders_.between(numbers_.of(run.label), numbers_.of(next.label));
    ++contact.upright;
    const float here_m = std::min(clearance_m_[run.end - 1], clearance_m_[run.end]);
    contact.clearance_m = std::max(contact.clearance_m, here_m);
  }
  void note_level(const PieceRun& run, const PieceRun& above, std::uint32_t width) {
    Contact& contact = borders_.between(numbers_.of(run.label), numbers_.of(above.label));
    const std::uint32_t first = std::max(run.first, above.first - width),
                        end = std::min(run.end, above.end - width);
    contact.level += end - first;
    for (std::size_t i = first; i < end; ++i)
      contact.clearance_m = std::max(contact.clearance_m, std::min(clearance_m_[i], clearance_m_[i + width]));
  }
  /// From the centres of cells to their sides.
  void pad_boxes() {
    const double half = 0.5 * map_.resolution_m * (std::abs(frame_.cos) + std::abs(frame_.sin));
    for (Region& region : regions_) {
      region.box.min -= types::Vector2(half, half);
      region.box.max += types::Vector2(half, half);
    }
  }

  const DenseMap& map_;
  std::span<const float> clearance_m_;
  const CompassFrame& frame_;
  const PieceNumbers& numbers_;
  std::vector<Region>& regions_;
  Borders& borders_;
};

inline void extend_by_disc(types::Rectangle& box, const types::Vector2& centre, double radius_m) {
  box.min = box.min.cwiseMin(centre - types::Vector2(radius_m, radius_m));
  box.max = box.max.cwiseMax(centre + types::Vector2(radius_m, radius_m));
}

void add_cores(const DenseMap& map, std::span<const float> clearance_m, const FirstLabels& first,
               const PieceNumbers& numbers, const CompassFrame& frame, std::vector<Region>& regions) {
  const double compass_rad = std::atan2(frame.sin, frame.cos),
               step_rad = std::numbers::pi / 2.0 / (kTurns + 1);
  std::vector<CompassFrame> turns;
  for (std::size_t k = 0; k < kTurns; ++k)
    turns.emplace_back(compass_rad + static_cast<double>(k + 1) * step_rad);
  for (std::size_t n = 0; n < first.axis.size(); ++n) {
    const std::uint32_t i = first.axis[n];
    fetch_ahead(first.labels.data(), first.axis, n);
    fetch_ahead(clearance_m.data(), first.axis, n);
    Region& region = regions[numbers.of(first.labels[i])];
    const types::Vector2 centre = map.centre_of(map.cell(i));
    const double r = std::abs(static_cast<double>(clearance_m[i]) - 0.5 * map.resolution_m);
    extend_by_disc(region.core, frame.from_map(centre), r);
    for (std::size_t k = 0; k < kTurns; ++k) extend_by_disc(region.turned[k], turns[k].from_map(centre), r);
  }
  for (Region& region : regions) {
    region.core.min = region.core.min.cwiseMax(region.box.min);
    region.core.max = region.core.max.cwiseMin(region.box.max);
  }
}

/// First label met from `p` on in the given direction: beyond the wall's thickness there is what it bounds.
std::uint32_t label_beside(const DenseMap& map, const std::vector<std::uint32_t>& labels,
                           const types::Vector2& p, const types::Vector2& direction) {
  constexpr double kReachM = 0.40;
  for (double d = 0.5 * map.resolution_m; d <= kReachM; d += map.resolution_m) {
    const grid::CellIndex cell = map.cell_at(p + d * direction);
    if (!map.contains(cell)) return 0;
    const std::uint32_t label = labels[map.index(cell)];
    if (label != 0) return label;
  }
  return 0;
}

void note_walls(const DenseMap& map, const std::vector<std::uint32_t>& labels, const PieceNumbers& numbers,
                std::span<const types::Segment> walls, std::vector<Region>& regions, Borders& borders) {
  constexpr double kStepM = 0.10;
  for (const types::Segment& wall : walls) {
    const double length_m = wall.length_m();
    if (!(length_m > 0.0) || !std::isfinite(length_m)) continue;
    const types::Vector2 along = (wall.b - wall.a) / length_m, across(-along.y(), along.x());
    for (double d = 0.5 * kStepM; d < length_m; d += kStepM) {
      const types::Vector2 p = wall.a + d * along;
      const std::uint32_t a = label_beside(map, labels, p, across);
      if (a == 0) continue;
      const std::uint32_t b = label_beside(map, labels, p, -across);
      if (b == 0) continue;
      float& wall_m =
          a == b ? regions[numbers.of(a)].straddled_m : borders.between(numbers.of(a), numbers.of(b)).wall_m;
      wall_m += static_cast<float>(kStepM);
    }
  }
}

}  // namespace

std::vector<Region> regions_of(const DenseMap& map, std::span<const float> clearance_m,
                               const FirstLabels& first, std::span<const types::Segment> walls,
                               const CompassFrame& frame) {
  std::vector<Region> regions(first.pieces.size());
  Borders borders(regions.size());
  const PieceNumbers numbers(first, map.cells.size());
  CellSums(map, clearance_m, frame, numbers, regions, borders).add(first.runs);
  add_cores(map, clearance_m, first, numbers, frame, regions);
  note_walls(map, first.labels, numbers, walls, regions, borders);
  borders.hand_out(regions);
  return regions;
}

}  // namespace topo::places

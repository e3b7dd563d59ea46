// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cassert>
#include <numbers>
#include <utility>

#include "core/places/segmentation/borders.hpp"
#include "core/places/segmentation/regions.hpp"
#include "core/places/skeleton/fetch_ahead.hpp"

namespace topo::places {
namespace {

using grid::DenseMap;

/// Which regions are computed anew, by number.
using IsNew = std::vector<std::uint8_t>;

/// Input of all sums.
struct Source {
  const DenseMap& map;
  std::span<const float> clearance_m;
  const FirstLabels& first;
  const CompassFrame& frame;
};

/// Sums over the cells of new regions, and over all borders of these.
class CellSums {
 public:
  CellSums(const Source& source, const IsNew& is_new, std::vector<Region>& regions, Borders& borders)
      : map_(source.map),
        clearance_m_(source.clearance_m),
        frame_(source.frame),
        runs_(source.first.runs),
        pieces_(source.first.run_pieces),
        is_new_(is_new),
        regions_(regions),
        borders_(borders) {}

  void add() {
    const bool all = std::find(is_new_.begin(), is_new_.end(), 0) == is_new_.end();
    std::size_t above = 0, below = 0;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      if (!is_new(k)) continue;
      add_run(k);
      if (k + 1 < runs_.size() && runs_[k + 1].first == runs_[k].end) note_upright(k, k + 1);
      note_above(k, above);
      if (all) continue;
      // A border with another new run is noted from that run.
      if (k > 0 && !is_new(k - 1) && runs_[k - 1].end == runs_[k].first) note_upright(k - 1, k);
      note_below(k, below);
    }
    pad_boxes();
  }

 private:
  [[nodiscard]] bool is_new(std::size_t k) const { return is_new_[pieces_[k]] != 0; }

  void add_run(std::size_t k) {
    const PieceRun& run = runs_[k];
    Region& region = regions_[pieces_[k]];
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
  void note_upright(std::size_t left, std::size_t right) {
    auto& between = borders_.between(pieces_[left], pieces_[right]);
    ++between.upright;
    const std::uint32_t i = runs_[right].first;
    between.clearance_m = std::max(between.clearance_m, std::min(clearance_m_[i - 1], clearance_m_[i]));
  }
  /// `above`: no earlier run ends above this run or later; advances with `k`.
  void note_above(std::size_t k, std::size_t& above) {
    const std::uint32_t first = runs_[k].first + width_, end = runs_[k].end + width_;
    while (above < runs_.size() && runs_[above].end <= first) ++above;
    for (std::size_t a = above; a < runs_.size() && runs_[a].first < end; ++a)
      if (pieces_[a] != pieces_[k]) note_level(k, a);
  }
  /// The same for the runs below that are not new.
  void note_below(std::size_t k, std::size_t& below) {
    const std::uint32_t first = runs_[k].first - width_, end = runs_[k].end - width_;
    while (runs_[below].end <= first) ++below;
    for (std::size_t b = below; runs_[b].first < end; ++b)
      if (!is_new(b)) note_level(b, k);
  }
  void note_level(std::size_t low, std::size_t high) {
    auto& between = borders_.between(pieces_[low], pieces_[high]);
    const std::uint32_t first = std::max(runs_[low].first, runs_[high].first - width_),
                        end = std::min(runs_[low].end, runs_[high].end - width_);
    between.level += end - first;
    for (std::size_t i = first; i < end; ++i)
      between.clearance_m =
          std::max(between.clearance_m, std::min(clearance_m_[i], clearance_m_[i + width_]));
  }
  /// Extends boxes from the centres of cells to their sides.
  void pad_boxes() {
    const double half = 0.5 * map_.resolution_m * (std::abs(frame_.cos) + std::abs(frame_.sin));
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      if (is_new_[r] == 0) continue;
      regions_[r].box.min -= types::Vector2(half, half);
      regions_[r].box.max += types::Vector2(half, half);
    }
  }

  const DenseMap& map_;
  std::uint32_t width_ = static_cast<std::uint32_t>(map_.width());
  std::span<const float> clearance_m_;
  const CompassFrame& frame_;
  std::span<const PieceRun> runs_;
  std::span<const std::uint32_t> pieces_;  ///< of the runs
  const IsNew& is_new_;
  std::vector<Region>& regions_;
  Borders& borders_;
};

inline void extend_by_disc(types::Rectangle& box, const types::Vector2& centre, double radius_m) {
  box.min = box.min.cwiseMin(centre - types::Vector2(radius_m, radius_m));
  box.max = box.max.cwiseMax(centre + types::Vector2(radius_m, radius_m));
}

void add_cores(const Source& source, const IsNew& is_new, std::vector<Region>& regions) {
  const CompassFrame& frame = source.frame;
  const double compass_rad = std::atan2(frame.sin, frame.cos),
               step_rad = std::numbers::pi / 2.0 / (kTurns + 1);
  std::vector<CompassFrame> turns;
  for (std::size_t k = 0; k < kTurns; ++k)
    turns.emplace_back(compass_rad + static_cast<double>(k + 1) * step_rad);
  const FirstLabels& first = source.first;
  for (std::size_t n = 0; n < first.axis.size(); ++n) {
    const std::uint32_t i = first.axis[n], r = first.axis_pieces[n];
    if (is_new[r] == 0) continue;
    fetch_ahead(source.clearance_m.data(), first.axis, n);
    Region& region = regions[r];
    const types::Vector2 centre = source.map.centre_of(source.map.cell(i));
    const double reach_m =
        std::abs(static_cast<double>(source.clearance_m[i]) - 0.5 * source.map.resolution_m);
    extend_by_disc(region.core, frame.from_map(centre), reach_m);
    for (std::size_t k = 0; k < kTurns; ++k)
      extend_by_disc(region.turned[k], turns[k].from_map(centre), reach_m);
  }
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (is_new[r] == 0) continue;
    regions[r].core.min = regions[r].core.min.cwiseMax(regions[r].box.min);
    regions[r].core.max = regions[r].core.max.cwiseMin(regions[r].box.max);
  }
}

/// The present number of each earlier piece; UINT32_MAX: the piece has changed or is gone.
std::vector<std::uint32_t> numbers_now(const std::vector<std::uint32_t>& before, const PieceNumbers& numbers,
                                       const FirstLabels& first) {
  std::vector<std::uint32_t> now(before.size(), UINT32_MAX);
  for (std::size_t p = 0; p < before.size(); ++p) {
    const auto& changed = first.change->pieces;
    if (std::binary_search(changed.begin(), changed.end(), before[p])) continue;
    now[p] = numbers.of(before[p]);
    assert(first.pieces[now[p]] == before[p]);
  }
  return now;
}

/// Moves unchanged regions, and the borders between two of them, to their present numbers. Returns which of
/// the regions are new.
IsNew carry_over(const std::vector<std::uint32_t>& now, std::vector<Region>& before,
                 std::vector<Region>& regions, Borders& borders) {
  IsNew is_new(regions.size(), 1);
  for (std::size_t p = 0; p < now.size(); ++p) {
    if (now[p] == UINT32_MAX) continue;
    for (const Contact& c : before[p].contacts) {
      if (c.other < p || now[c.other] == UINT32_MAX || c.upright + c.level == 0) continue;
      auto& between = borders.between(now[p], now[c.other]);
      between.upright = c.upright;
      between.level = c.level;
      between.clearance_m = c.clearance_m;
    }
  }
  for (std::size_t p = 0; p < now.size(); ++p) {
    if (now[p] == UINT32_MAX) continue;
    is_new[now[p]] = 0;
    regions[now[p]] = std::move(before[p]);
  }
  return is_new;
}

void note_walls(const WallSides& walls, const PieceNumbers& numbers, std::vector<Region>& regions,
                Borders& borders) {
  std::vector<std::uint32_t> straddled(regions.size(), 0);
  for (const WallBetween& wall : walls.all()) {
    const std::uint32_t a = numbers.of(wall.a), b = numbers.of(wall.b);
    (a == b ? straddled[a] : borders.between(a, b).wall_steps) += wall.steps;
  }
  for (std::size_t r = 0; r < regions.size(); ++r) regions[r].straddled_m = wall_length_m(straddled[r]);
}

}  // namespace

void renew_regions(const DenseMap& map, std::span<const float> clearance_m, const FirstLabels& first,
                   std::span<const types::Segment> walls, const CompassFrame& frame, RegionMemory& memory) {
  const bool again = first.change && memory.frame == frame;
  const PieceNumbers numbers(first, map.cells.size());
  std::vector<Region> regions(first.pieces.size());
  Borders borders(regions.size());
  const IsNew is_new =
      again ? carry_over(numbers_now(memory.pieces, numbers, first), memory.regions, regions, borders)
            : IsNew(regions.size(), 1);
  const Source source{map, clearance_m, first, frame};
  CellSums(source, is_new, regions, borders).add();
  add_cores(source, is_new, regions);
  memory.walls.take(map, first.labels, walls, first.change);
  note_walls(memory.walls, numbers, regions, borders);
  borders.hand_out(regions);
  memory.frame = frame;
  memory.pieces = first.pieces;
  memory.regions = std::move(regions);
}

}  // namespace topo::places

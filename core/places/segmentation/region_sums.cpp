// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numbers>

#include "core/places/segmentation/borders.hpp"
#include "core/places/segmentation/regions.hpp"
#include "core/places/segmentation/wall_sides.hpp"
#include "core/places/skeleton/fetch_ahead.hpp"

namespace topo::places {
namespace {

using grid::DenseMap;

/// Input of all sums.
struct Source {
  const DenseMap& map;
  std::span<const float> clearance_m;
  const FirstLabels& first;
  const CompassFrame& frame;
};

/// Sums over the cells of regions, and over their borders.
class CellSums {
 public:
  CellSums(const Source& source, std::vector<Region>& regions, Borders& borders)
      : map_(source.map),
        clearance_m_(source.clearance_m),
        frame_(source.frame),
        runs_(source.first.runs),
        pieces_(source.first.run_pieces),
        regions_(regions),
        borders_(borders) {}

  void add() {
    std::size_t above = 0;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      add_run(k);
      if (k + 1 < runs_.size() && runs_[k + 1].first == runs_[k].end) note_upright(k, k + 1);
      note_above(k, above);
    }
    pad_boxes();
  }

 private:
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
    for (Region& region : regions_) {
      region.box.min -= types::Vector2(half, half);
      region.box.max += types::Vector2(half, half);
    }
  }

  const DenseMap& map_;
  std::uint32_t width_ = static_cast<std::uint32_t>(map_.width());
  std::span<const float> clearance_m_;
  const CompassFrame& frame_;
  std::span<const PieceRun> runs_;
  std::span<const std::uint32_t> pieces_;  ///< of the runs
  std::vector<Region>& regions_;
  Borders& borders_;
};

inline void extend_by_disc(types::Rectangle& box, const types::Vector2& centre, double radius_m) {
  box.min = box.min.cwiseMin(centre - types::Vector2(radius_m, radius_m));
  box.max = box.max.cwiseMax(centre + types::Vector2(radius_m, radius_m));
}

void add_cores(const Source& source, std::vector<Region>& regions) {
  const CompassFrame& frame = source.frame;
  const double compass_rad = std::atan2(frame.sin, frame.cos),
               step_rad = std::numbers::pi / 2.0 / (kTurns + 1);
  std::vector<CompassFrame> turns;
  for (std::size_t k = 0; k < kTurns; ++k)
    turns.emplace_back(compass_rad + static_cast<double>(k + 1) * step_rad);
  const FirstLabels& first = source.first;
  for (std::size_t n = 0; n < first.axis.size(); ++n) {
    const std::uint32_t i = first.axis[n], r = first.axis_pieces[n];
    fetch_ahead(source.clearance_m.data(), first.axis, n);
    Region& region = regions[r];
    const types::Vector2 centre = source.map.centre_of(source.map.cell(i));
    const double reach_m =
        std::abs(static_cast<double>(source.clearance_m[i]) - 0.5 * source.map.resolution_m);
    extend_by_disc(region.core, frame.from_map(centre), reach_m);
    for (std::size_t k = 0; k < kTurns; ++k)
      extend_by_disc(region.turned[k], turns[k].from_map(centre), reach_m);
  }
  for (Region& region : regions) {
    region.core.min = region.core.min.cwiseMax(region.box.min);
    region.core.max = region.core.max.cwiseMin(region.box.max);
  }
}

void note_walls(std::span<const WallBetween> walls, const PieceNumbers& numbers, std::vector<Region>& regions,
                Borders& borders, double step_m) {
  std::vector<std::uint32_t> straddled(regions.size(), 0);
  for (const WallBetween& wall : walls) {
    const std::uint32_t a = numbers.of(wall.a), b = numbers.of(wall.b);
    (a == b ? straddled[a] : borders.between(a, b).wall_steps) += wall.steps;
  }
  for (std::size_t r = 0; r < regions.size(); ++r)
    regions[r].straddled_m = wall_length_m(straddled[r], step_m);
}

}  // namespace

std::vector<Region> regions_of(const DenseMap& map, std::span<const float> clearance_m,
                               const FirstLabels& first, std::span<const types::Segment> walls,
                               const CompassFrame& frame, const WallSideParams& params) {
  std::vector<Region> regions(first.pieces.size());
  Borders borders(regions.size());
  const Source source{map, clearance_m, first, frame};
  CellSums(source, regions, borders).add();
  add_cores(source, regions);
  note_walls(wall_sides(map, first.labels, walls, params), PieceNumbers(first, map.cells.size()), regions,
             borders, params.step_m);
  borders.hand_out(regions, params.step_m);
  return regions;
}

}  // namespace topo::places

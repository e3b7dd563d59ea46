// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/floor_figures.hpp"

#include <algorithm>
#include <numeric>

#include "tests/sim/area.hpp"
#include "tests/sim/contours.hpp"

namespace topo::bench::fresh {
namespace {

constexpr double kRobot_m = 0.3;
constexpr double kStep_m = 0.6;
constexpr double kPassageMax_m = 2.1;
constexpr double kPlaceMin_m2 = 0.3;  // of a place, of the cells where the passage's disc fits
constexpr double kSmall_m = 1.0, kLarge_m = 3.0;

/// Cells by falling clearance, joined as they come.
class Places {
 public:
  Places(const sim::Raster& poses, const std::vector<float>& clearance)
      : poses_(poses),
        clearance_(clearance),
        parent_(clearance.size(), kNone),
        peak_(clearance.size(), 0.0F),
        cells_(clearance.size(), 0) {}

  /// Calls `met(peak, peak, cells, cells)` for each two places that a cell joins.
  template <class Met>
  void add(std::size_t cell, Met&& met) {
    parent_[cell] = cell;
    peak_[cell] = clearance_[cell];
    cells_[cell] = 1;
    const auto width = static_cast<std::size_t>(poses_.width);
    const int x = static_cast<int>(cell % width), y = static_cast<int>(cell / width);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!poses_.inside(x + dx, y + dy)) continue;
        const std::size_t other = poses_.index(x + dx, y + dy);
        if (other == cell || parent_[other] == kNone) continue;
        join(root(cell), root(other), met);
      }
    }
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  template <class Met>
  void join(std::size_t a, std::size_t b, Met&& met) {
    if (a == b) return;
    met(peak_[a], peak_[b], cells_[a], cells_[b]);
    if (peak_[a] < peak_[b]) std::swap(a, b);
    parent_[b] = a;
    cells_[a] += cells_[b];
  }

  const sim::Raster& poses_;
  const std::vector<float>& clearance_;
  std::vector<std::size_t> parent_;
  std::vector<float> peak_;
  std::vector<std::size_t> cells_;
};

sim::Raster near_to(const sim::Raster& free, const sim::Raster& poses, double step_m) {
  sim::Raster away = poses;
  for (std::uint8_t& cell : away.cells) cell = cell == 0 ? 1 : 0;
  const std::vector<float> distance = sim::clearance_m(away);
  sim::Raster floor = free;
  for (std::size_t i = 0; i < floor.cells.size(); ++i) {
    if (static_cast<double>(distance[i]) > step_m) floor.cells[i] = 0;
  }
  return floor;
}

/// Numbers of the solid pieces that border on the floor.
std::vector<bool> pieces_on(const sim::Raster& floor, const sim::Pieces& pieces) {
  std::vector<bool> on(pieces.box.size(), false);
  for (int y = 0; y < floor.height; ++y) {
    for (int x = 0; x < floor.width; ++x) {
      if (floor.at(x, y) == 0) continue;
      for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
        if (floor.inside(x + dx, y + dy)) on[pieces.label[floor.index(x + dx, y + dy)]] = true;
      }
    }
  }
  return on;
}

}  // namespace

std::vector<double> passage_widths_m(const sim::Raster& free, const sim::Raster& poses) {
  const std::vector<float> clearance = sim::clearance_m(free);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < poses.cells.size(); ++i) {
    if (poses.cells[i] != 0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return clearance[a] > clearance[b]; });
  const double cell_m2 = free.resolution_m * free.resolution_m;
  std::vector<double> widths;
  Places places(poses, clearance);
  for (const std::size_t cell : order) {
    // From the middle of a cell to that of a solid one: half a cell less is free.
    const double width_m = 2.0 * static_cast<double>(clearance[cell]) - free.resolution_m;
    places.add(cell, [&](float peak_a, float peak_b, std::size_t cells_a, std::size_t cells_b) {
      const double lower_m = 2.0 * static_cast<double>(std::min(peak_a, peak_b)) - free.resolution_m;
      const double less_m2 = static_cast<double>(std::min(cells_a, cells_b)) * cell_m2;
      if (width_m <= kPassageMax_m && lower_m >= width_m + kWider_m && less_m2 >= kPlaceMin_m2)
        widths.push_back(width_m);
    });
  }
  return widths;
}

FloorFigures floor_figures(const sim::Raster& free, const sim::Vector2& start) {
  const sim::Raster poses = sim::reachable_poses(free, start, kRobot_m);
  const sim::Raster floor = near_to(free, poses, kStep_m);
  sim::Raster solid = free;
  for (std::uint8_t& cell : solid.cells) cell = cell == 0 ? 1 : 0;
  const sim::Pieces pieces = sim::label_pieces(solid);
  const std::vector<bool> on = pieces_on(floor, pieces);
  FloorFigures figures;
  figures.floor_m2 = floor.area_m2();
  figures.doors_m = passage_widths_m(free, poses);
  std::vector<bool> stands(on.size(), false);
  std::size_t small = 0;
  for (std::size_t i = 1; i < on.size(); ++i) {
    const double across_m = (pieces.box[i].max - pieces.box[i].min).maxCoeff();
    stands[i] = on[i] && !pieces.at_border[i] && across_m <= kLarge_m;
    small += stands[i] && across_m < kSmall_m ? 1U : 0U;
  }
  std::size_t under = 0;
  for (const std::uint32_t label : pieces.label) under += stands[label] ? 1U : 0U;
  const double under_m2 = static_cast<double>(under) * free.resolution_m * free.resolution_m;
  if (figures.floor_m2 <= 0.0) return figures;
  figures.pieces_per_100m2 = 100.0 * static_cast<double>(small) / figures.floor_m2;
  figures.furnished_share = under_m2 / (figures.floor_m2 + under_m2);
  return figures;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

}  // namespace topo::bench::fresh

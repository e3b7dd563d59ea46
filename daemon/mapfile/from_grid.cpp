// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "core/grid/occupancy_grid.hpp"
#include "daemon/mapfile/map_image.hpp"

namespace topo::daemon {

using types::Errc;
using types::Result;

Result<MapImage> image_of(const grid::OccupancyGrid& grid, int margin_cells) {
  grid::CellBox box = grid.known_box();
  if (box.empty()) box.extend({0, 0});
  const std::int64_t width = box.width() + 2 * margin_cells, height = box.height() + 2 * margin_cells;
  if (width > MapImage::kMaxSide || height > MapImage::kMaxSide || width * height > MapImage::kMaxCells) {
    return types::fail(Errc::kInvalidInput,
                       fmt::format("the map: found {} x {} cells, expected at most {} a side and {} in all",
                                   width, height, MapImage::kMaxSide, MapImage::kMaxCells));
  }
  const std::int64_t left = std::int64_t{box.min.x} - margin_cells,
                     low = std::int64_t{box.min.y} - margin_cells;
  MapImage image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.resolution_m = grid.resolution_m();
  image.origin = {static_cast<double>(left) * grid.resolution_m(),
                  static_cast<double>(low) * grid.resolution_m(), 0.0};
  image.cells.assign(static_cast<std::size_t>(width * height), MapCell::kUnknown);
  grid.for_each_known([&](grid::CellIndex cell, grid::CellState state) {
    const auto x = static_cast<int>(cell.x - left), y = static_cast<int>(cell.y - low);
    image.cells[image.index(x, y)] =
        state == grid::CellState::kOccupied ? MapCell::kOccupied : MapCell::kFree;
  });
  return image;
}

}  // namespace topo::daemon

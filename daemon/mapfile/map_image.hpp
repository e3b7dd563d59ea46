// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/grid/occupancy_grid.hpp"
#include "core/types/result.hpp"
#include "core/types/se2.hpp"

namespace topo::daemon {

enum class MapCell : std::uint8_t { kFree, kOccupied, kUnknown };

/// A map as a raster, as in the files. Cells row by row, the bottom row (smallest y) first; the files' images
/// have the top row first.
struct MapImage {
  static constexpr int kMaxSide = 32768;
  static constexpr std::int64_t kMaxCells = std::int64_t{1} << 27;  ///< 11585 cells per side when square

  int width = 0;
  int height = 0;
  double resolution_m = 0.05;
  types::Se2 origin;  ///< pose of the lower left corner of cell (0, 0), in map
  std::vector<MapCell> cells;
  /// What load_map() took otherwise than the file has it, a sentence each.
  std::vector<std::string> warnings = {};

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] MapCell at(int x, int y) const { return cells[index(x, y)]; }
};

/// The smallest raster that contains all known cells and a margin around them; without known cells, one
/// unknown cell and the margin. kInvalidInput when it would exceed MapImage's limits.
types::Result<MapImage> image_of(const grid::OccupancyGrid& grid, int margin_cells = 4);

/// Writes map_server's pair, `map.pgm` and `map.yaml`, into an existing folder; both or neither. Blocks on
/// the disk.
types::Status save_map(const std::string& folder, const MapImage& map);

/// The bytes of the pair that save_map() writes.
[[nodiscard]] std::vector<std::byte> encode_pgm(const MapImage& map);
[[nodiscard]] std::string encode_map_yaml(const MapImage& map, const std::string& image_name);

/// Reads a map_server YAML file and its image (PGM P2 or P5, PNG), whose path is relative to the YAML file's
/// folder. With a warning, an image that is not where the file says is taken from beside it, and a yaw that
/// is no number (an old map_saver wrote such) is taken as 0. Duplicate keys are refused. Errors give the
/// file, the key or position, the value found and the expected form: kInvalidInput, kNotFound, kPermission,
/// kIo.
types::Result<MapImage> load_map(const std::string& yaml_path);

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/types/result.hpp"
#include "core/types/se2.hpp"

namespace topo::bench {

/// A map as the analysis takes it, and where its cells lie in the picture that it came from.
struct MapInput {
  grid::DenseMap map;  ///< what is known, with one unknown cell around it
  int width = 0;       ///< of the picture
  int height = 0;
  types::Vector2 origin{0.0, 0.0};  ///< of the picture's lower left corner, in the frame of its YAML file
  std::vector<std::string> warnings = {};  ///< of daemon::load_map

  /// Index of a cell in the picture, whose uppermost row is the first; the cell must be inside.
  [[nodiscard]] std::size_t pixel(grid::CellIndex cell) const {
    return static_cast<std::size_t>(height - 1 - cell.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(cell.x);
  }
  [[nodiscard]] bool inside(grid::CellIndex cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.x < width && cell.y < height;
  }
};

/// Is it a map_server file, and no picture, by its name?
[[nodiscard]] bool names_map_yaml(const std::string& path);

/// Reads a map_server YAML file, whose resolution and thresholds hold, or a picture alone (PNG, PGM): there
/// 250 and more is free, under 89 occupied, everything else unknown, and a pixel is `resolution_m`, which
/// must be from 0.001 to 10. Cell (0, 0) is the picture's lower left pixel. Errors as daemon::load_map has
/// them.
types::Result<MapInput> read_map_input(const std::string& path, double resolution_m);

/// Prints the warnings on a map to standard error, a line each.
void print_warnings(const std::string& path, const std::vector<std::string>& warnings);

}  // namespace topo::bench

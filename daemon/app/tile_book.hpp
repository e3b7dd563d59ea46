// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/grid/occupancy_grid.hpp"

namespace topo::daemon {

/// Square block of cells as displays get it.
struct ViewTile {
  std::int32_t x = 0, y = 0;  ///< index of the tile: index of its cells divided by the side, rounded down
  std::uint64_t number = 0;   ///< of its newest change
  std::string cells;          ///< encode_cells()
};

/// The cells' states as runs, row by row from the lowest y, in characters that JSON leaves as they are. Each
/// character stands for six bits (A-Z, a-z, 0-9, -, _ for 0 to 63). Below 48 its two upper bits are the state
/// (0 unknown, 1 free, 2 occupied) and its four lower ones a length of 1 to 16; 48 + n lengthens the run
/// that follows by 16 (n + 1). So 4,096 equal cells take 31 characters, and no tile takes more than it has
/// cells.
std::string encode_cells(std::span<const grid::CellState> cells);

/// The map as tiles for displays, and when each changed. A display that says up to which change it has the
/// map gets what came after. Pure; one thread at a time.
class TileBook {
 public:
  static constexpr std::int32_t kSide = 64;  ///< cells

  /// Takes in the map as it is now. Tiles that it no longer has become unknown. Costs one pass over the map.
  void update(const grid::OccupancyGrid& map);

  /// The tiles that changed after change number `since`, in the order of their changes, until they hold
  /// `most_bytes` (at least one). Valid until the next update.
  struct Part {
    std::vector<const ViewTile*> tiles;
    std::uint64_t number = 0;  ///< of the newest change that the display then has
    bool more = false;
  };
  [[nodiscard]] Part since(std::uint64_t since, std::size_t most_bytes) const;

 private:
  struct Index {
    std::int32_t x = 0, y = 0;
    friend auto operator<=>(const Index&, const Index&) = default;
  };
  void note(Index index, std::string cells);

  std::map<Index, ViewTile> tiles_;
  std::uint64_t changes_ = 0;
};

}  // namespace topo::daemon

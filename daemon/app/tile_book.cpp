// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/tile_book.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

namespace topo::daemon {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
constexpr std::size_t kShortRun = 16;
constexpr std::size_t kLongRun = kShortRun * 17;
constexpr std::size_t kLengthens = 48;

constexpr std::size_t kCells = static_cast<std::size_t>(TileBook::kSide) * TileBook::kSide;
constexpr std::int32_t kGridTiles = TileBook::kSide / grid::Tile::kSide;  ///< along a side
static_assert(kGridTiles == 2);

/// The states of one display tile. Blocks of the grid that are not there are unknown.
std::array<grid::CellState, kCells> states_of(const grid::OccupancyGrid& map, std::int32_t x,
                                              std::int32_t y) {
  std::array<grid::CellState, kCells> states{};
  for (std::int32_t block = 0; block < kGridTiles * kGridTiles; ++block) {
    const std::int32_t bx = block % kGridTiles, by = block / kGridTiles;
    const auto* tile = map.tiles().find(patricia::cell_key(x * kGridTiles + bx, y * kGridTiles + by));
    if (tile == nullptr) continue;
    for (int row = 0; row < grid::Tile::kSide; ++row) {
      for (int column = 0; column < grid::Tile::kSide; ++column) {
        const std::int32_t cx = bx * grid::Tile::kSide + column, cy = by * grid::Tile::kSide + row;
        states[static_cast<std::size_t>(cy * TileBook::kSide + cx)] =
            grid::state_of(tile->read().cells[grid::Tile::index(column, row)]);
      }
    }
  }
  return states;
}

}  // namespace

std::string encode_cells(std::span<const grid::CellState> cells) {
  std::string text;
  for (std::size_t at = 0; at < cells.size();) {
    std::size_t length = 1;
    while (length < kLongRun && at + length < cells.size() && cells[at + length] == cells[at]) ++length;
    const std::size_t lengthened = (length - 1) / kShortRun;
    if (lengthened > 0) text += kDigits[kLengthens + lengthened - 1];
    text += kDigits[static_cast<std::size_t>(cells[at]) * kShortRun + (length - 1) % kShortRun];
    at += length;
  }
  return text;
}

void TileBook::update(const grid::OccupancyGrid& map) {
  std::set<Index> present;
  map.tiles().for_each([&](patricia::Key key, const grid::TileRef&) {
    const patricia::Cell tile = patricia::cell_of(key);
    present.insert({tile.x >> 1, tile.y >> 1});  // divided by kGridTiles, towards minus infinity
  });
  for (const auto& [index, tile] : tiles_) present.insert(index);
  for (const Index index : present) note(index, encode_cells(states_of(map, index.x, index.y)));
}

void TileBook::note(Index index, std::string cells) {
  ViewTile& tile = tiles_[index];
  if (tile.cells == cells) return;
  tile = {index.x, index.y, ++changes_, std::move(cells)};
}

TileBook::Part TileBook::since(std::uint64_t since, std::size_t most_bytes) const {
  Part part{{}, std::min(since, changes_), false};
  for (const auto& [index, tile] : tiles_)
    if (tile.number > since) part.tiles.push_back(&tile);
  std::ranges::sort(part.tiles, {}, &ViewTile::number);
  std::size_t bytes = 0, taken = 0;
  while (taken < part.tiles.size() && (taken == 0 || bytes < most_bytes))
    bytes += part.tiles[taken++]->cells.size();
  part.more = taken < part.tiles.size();
  part.tiles.resize(taken);
  if (taken > 0) part.number = part.tiles.back()->number;
  return part;
}

}  // namespace topo::daemon

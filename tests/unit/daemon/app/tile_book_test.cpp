// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/tile_book.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

namespace topo::daemon {
namespace {

using grid::CellState;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::size_t kNoLimit = 1 << 30;
constexpr std::size_t kCells = static_cast<std::size_t>(TileBook::kSide) * TileBook::kSide;

/// As the page reads them, by the form's description.
std::vector<CellState> decode(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::vector<CellState> cells;
  std::size_t longer = 0;
  for (const char digit : text) {
    const std::size_t value = digits.find(digit);
    if (value >= 48) {
      longer = 16 * (value - 47);
      continue;
    }
    cells.insert(cells.end(), longer + value % 16 + 1, static_cast<CellState>(value / 16));
    longer = 0;
  }
  return cells;
}

class TileBookTest : public ::testing::Test {
 protected:
  void set(grid::CellIndex cell, std::uint16_t hits, std::uint16_t misses) {
    const std::int32_t tx = cell.x >> 5, ty = cell.y >> 5;
    map.tile_to_change(tx, ty).cells[grid::Tile::index(cell.x - 32 * tx, cell.y - 32 * ty)] = {hits, misses};
  }
  std::vector<std::pair<int, int>> changed(std::uint64_t since) {
    std::vector<std::pair<int, int>> places;
    for (const ViewTile* tile : book.since(since, kNoLimit).tiles) places.emplace_back(tile->x, tile->y);
    return places;
  }

  patricia::Arena<grid::TileRef> arena;
  grid::OccupancyGrid map{arena, 0.05};
  TileBook book;
};

TEST(EncodeCells, KeepsEveryCellAndTakesNoMoreThanTheyAre) {
  EXPECT_TRUE(rc::check([] {
    std::vector<CellState> cells;
    for (const int length : *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 700)))
      cells.insert(cells.end(), static_cast<std::size_t>(length),
                   static_cast<CellState>(*rc::gen::inRange(0, 3)));
    const std::string text = encode_cells(cells);
    RC_ASSERT(decode(text) == cells);
    RC_ASSERT(text.size() <= cells.size());
  }));
}

TEST(EncodeCells, ATileOfOneKindTakesFewCharacters) {
  EXPECT_EQ(encode_cells(std::vector<CellState>(kCells, CellState::kFree)).size(), 31U);
  EXPECT_EQ(encode_cells(std::vector<CellState>(1, CellState::kOccupied)), "g");
  EXPECT_EQ(encode_cells(std::vector<CellState>(17, CellState::kFree)), "wQ");
}

TEST_F(TileBookTest, HasTheMapsCellsOnBothSidesOfZero) {
  set({-1, -64}, 2, 0);
  set({-65, 3}, 0, 5);
  set({63, 63}, 0, 1);
  book.update(map);
  const auto part = book.since(0, kNoLimit);
  ASSERT_EQ(part.tiles.size(), 3U);
  std::size_t known = 0;
  for (const ViewTile* tile : part.tiles) {
    const auto cells = decode(tile->cells);
    ASSERT_EQ(cells.size(), kCells);
    for (std::size_t i = 0; i < kCells; ++i) {
      const int x = 64 * tile->x + static_cast<int>(i % 64), y = 64 * tile->y + static_cast<int>(i / 64);
      EXPECT_EQ(cells[i], map.state({x, y})) << x << " " << y;
      known += cells[i] == CellState::kUnknown ? 0U : 1U;
    }
  }
  EXPECT_EQ(known, 3U);
  EXPECT_FALSE(part.more);
}

TEST_F(TileBookTest, GivesWhatChangedSince) {
  set({0, 0}, 1, 0);
  set({100, 0}, 1, 0);
  book.update(map);
  const std::uint64_t first = book.since(0, kNoLimit).number;
  book.update(map);
  EXPECT_THAT(changed(first), IsEmpty());
  set({100, 5}, 0, 1);
  book.update(map);
  EXPECT_THAT(changed(first), ElementsAre(std::pair(1, 0)));
  EXPECT_THAT(changed(0), ElementsAre(std::pair(0, 0), std::pair(1, 0)));
}

TEST_F(TileBookTest, EvidenceThatChangesNoStateChangesNoTile) {
  set({0, 0}, 1, 0);
  book.update(map);
  const std::uint64_t first = book.since(0, kNoLimit).number;
  set({0, 0}, 2, 0);
  book.update(map);
  EXPECT_THAT(changed(first), IsEmpty());
}

TEST_F(TileBookTest, WhatIsGoneBecomesUnknown) {
  set({0, 0}, 1, 0);
  book.update(map);
  const std::uint64_t first = book.since(0, kNoLimit).number;
  map.clear();
  book.update(map);
  const auto part = book.since(first, kNoLimit);
  ASSERT_EQ(part.tiles.size(), 1U);
  EXPECT_EQ(decode(part.tiles.front()->cells), std::vector<CellState>(kCells, CellState::kUnknown));
}

TEST_F(TileBookTest, AnAnswerIsBoundedAndTheNextGoesOn) {
  for (int x = 0; x < 10; ++x) set({64 * x, 0}, 1, 0);
  book.update(map);
  std::uint64_t since = 0;
  std::size_t parts = 0, tiles = 0;
  for (bool more = true; more && parts < 20; ++parts) {
    const auto part = book.since(since, 70);  // a tile has 33 characters
    EXPECT_LE(part.tiles.size(), 3U);
    since = part.number;
    tiles += part.tiles.size();
    more = part.more;
  }
  EXPECT_EQ(parts, 4U);
  EXPECT_EQ(tiles, 10U);
}

TEST_F(TileBookTest, ANumberFromAnotherDaemonIsNoError) {
  set({0, 0}, 1, 0);
  book.update(map);
  const auto part = book.since(1'000'000, kNoLimit);
  EXPECT_THAT(part.tiles, IsEmpty());
  EXPECT_EQ(part.number, 1U);
}

}  // namespace
}  // namespace topo::daemon

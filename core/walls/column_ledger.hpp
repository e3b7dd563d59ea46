// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <unordered_map>

#include "core/walls/slab_counts.hpp"
#include "core/walls/wall_store.hpp"

namespace topo::walls {

/// Draws columns into a store from which nothing will be removed. `columns` are in base_link; `T_map_base` is
/// the pose from which they were seen.
void draw_columns(WallStore& store, std::span<const ColumnPoint> columns, const types::Se2& T_map_base);

/// Draws columns into a wall store and removes them exactly: an OR cannot be undone, a count can. Keeps the
/// counts of one store; snapshots of the store need none.
class ColumnLedger {
 public:
  /// As draw_columns.
  void draw(WallStore& store, std::span<const ColumnPoint> columns, const types::Se2& T_map_base);

  /// Moves columns from the pose at which they were drawn to another one. Columns that stay in their cell
  /// change nothing.
  void move(WallStore& store, std::span<const ColumnPoint> columns, const types::Se2& before,
            const types::Se2& after);

 private:
  void add(WallStore& store, patricia::Key cell, Slabs slabs);
  void remove(WallStore& store, patricia::Key cell, Slabs slabs);

  std::unordered_map<patricia::Key, SlabCounts> counts_;
};

}  // namespace topo::walls

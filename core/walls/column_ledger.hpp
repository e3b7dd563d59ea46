// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <unordered_map>

#include "core/walls/slab_counts.hpp"
#include "core/walls/wall_store.hpp"

namespace topo::walls {

/// Draws columns into a store that nothing will be taken back from. `columns` in base_link, `T_map_base`
/// where they were seen from.
void draw_columns(WallStore& store, std::span<const ColumnPoint> columns, const types::Se2& T_map_base);

/// Draws columns into a wall store and takes them back exactly: what was ORed cannot be taken back, but what
/// was counted can. Keeps the counts of one store; versions of it that others hold need none.
class ColumnLedger {
 public:
  /// As draw_columns.
  void draw(WallStore& store, std::span<const ColumnPoint> columns, const types::Se2& T_map_base);

  /// From where they were drawn to elsewhere. What stays in its cell costs nothing.
  void move(WallStore& store, std::span<const ColumnPoint> columns, const types::Se2& before,
            const types::Se2& after);

 private:
  void add(WallStore& store, patricia::Key cell, Slabs slabs);
  void remove(WallStore& store, patricia::Key cell, Slabs slabs);

  std::unordered_map<patricia::Key, SlabCounts> counts_;
};

}  // namespace topo::walls

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/column_ledger.hpp"

namespace topo::walls {
namespace {

/// Computes the cell of a column, for many columns seen from one pose.
class CellsFrom {
 public:
  CellsFrom(const WallStore& store, const types::Se2& T_map_base)
      : store_(store),
        pose_(T_map_base),
        cos_(std::cos(T_map_base.theta_rad)),
        sin_(std::sin(T_map_base.theta_rad)) {}

  [[nodiscard]] patricia::Key operator()(const ColumnPoint& column) const {
    const auto x = static_cast<double>(column.x_m), y = static_cast<double>(column.y_m);
    return store_.cell_at({pose_.x_m + cos_ * x - sin_ * y, pose_.y_m + sin_ * x + cos_ * y});
  }

 private:
  const WallStore& store_;
  const types::Se2& pose_;
  double cos_, sin_;
};

}  // namespace

void draw_columns(WallStore& store, std::span<const ColumnPoint> columns, const types::Se2& T_map_base) {
  const CellsFrom cell(store, T_map_base);
  for (const ColumnPoint& column : columns) store.add(cell(column), column.slabs);
}

void ColumnLedger::draw(WallStore& store, std::span<const ColumnPoint> columns,
                        const types::Se2& T_map_base) {
  const CellsFrom cell(store, T_map_base);
  for (const ColumnPoint& column : columns) add(store, cell(column), column.slabs);
}

void ColumnLedger::move(WallStore& store, std::span<const ColumnPoint> columns, const types::Se2& before,
                        const types::Se2& after) {
  const CellsFrom cell_before(store, before), cell_after(store, after);
  for (const ColumnPoint& column : columns) {
    const patricia::Key was = cell_before(column), is = cell_after(column);
    if (was == is) continue;
    add(store, is, column.slabs);
    remove(store, was, column.slabs);
  }
}

void ColumnLedger::add(WallStore& store, patricia::Key cell, Slabs slabs) {
  counts_[cell].add(slabs);
  store.add(cell, slabs);
}

void ColumnLedger::remove(WallStore& store, patricia::Key cell, Slabs slabs) {
  const auto at = counts_.find(cell);
  if (at == counts_.end()) return;
  at->second.remove(slabs);
  const Slabs seen = at->second.seen();
  store.set(cell, seen);
  if (seen == 0) counts_.erase(at);
}

}  // namespace topo::walls

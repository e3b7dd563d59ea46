// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "core/patricia/map.hpp"
#include "core/types/se2.hpp"
#include "core/walls/height_column.hpp"

namespace topo::walls {

/// Sparse heights over the cells of the map (paper section II-B): a persistent Patricia tree, so that a
/// snapshot costs O(1) and an analysis runs while new columns are added.
class WallStore {
 public:
  using Columns = patricia::Map<Slabs>;

  WallStore(patricia::Arena<Slabs>& arena, double resolution_m)
      : columns_(arena), resolution_m_(resolution_m) {}

  /// The cell that contains a point of the map frame.
  [[nodiscard]] patricia::Key cell_at(const types::Vector2& p_map) const {
    const auto cell = [&](double v) { return static_cast<std::int32_t>(std::floor(v / resolution_m_)); };
    return patricia::cell_key(cell(p_map.x()), cell(p_map.y()));
  }

  /// ORs the slabs into a cell: a second observation must not erase the first.
  void add(patricia::Key cell, Slabs slabs) {
    columns_.insert_with(cell, slabs, [](Slabs a, Slabs b) { return a | b; });
  }

  /// Replaces the slabs of a cell; 0 removes the cell.
  void set(patricia::Key cell, Slabs slabs) {
    if (slabs == 0)
      columns_.erase(cell);
    else
      columns_.insert(cell, slabs);
  }

  [[nodiscard]] const Columns& columns() const { return columns_; }
  [[nodiscard]] double resolution_m() const { return resolution_m_; }

 private:
  Columns columns_;
  double resolution_m_;
};

}  // namespace topo::walls

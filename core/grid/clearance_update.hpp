// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/grid/cell_blocks.hpp"
#include "core/grid/dense_map.hpp"

namespace topo::grid {

/// Cells that became occupied (`come`) and cells that are no longer occupied (`gone`) between two maps.
struct OccupiedChange {
  std::vector<std::uint32_t> come, gone;
};

/// Incremental clearance_m with kOccupiedOrUnknown (distance.hpp) for successive maps: a map that has grown
/// or was corrected costs a comparison of its cells and the transform around the changed cells. Always equal
/// to the transform of the whole map.
class ClearanceUpdate {
 public:
  ClearanceUpdate();
  ~ClearanceUpdate();
  ClearanceUpdate(const ClearanceUpdate&) = delete;
  ClearanceUpdate& operator=(const ClearanceUpdate&) = delete;

  void take(const DenseMap& map);
  /// The same without the comparison: `others` contains all cells that differ from the previous map. Ignored
  /// when that map had another box.
  void take(const DenseMap& map, const CellBlocks& others);

  /// Clearance of each cell of the last map. Valid until the next take().
  [[nodiscard]] const std::vector<float>& clearance_m() const;

  /// Cells of the last map whose clearance differs from that on the previous map, ascending; cells outside
  /// the previous map had clearance 0. nullopt when the previous map had another resolution or a box that is
  /// not inside this one's. Valid until the next take().
  [[nodiscard]] const std::optional<std::vector<std::uint32_t>>& changed() const;

  /// Difference between the last map and the previous one; meaningless when that had another box. Valid until
  /// the next take().
  [[nodiscard]] const OccupiedChange& occupied() const;

 private:
  struct Impl;
  void take(const DenseMap& map, const CellBlocks* others);
  std::unique_ptr<Impl> impl_;
};

}  // namespace topo::grid

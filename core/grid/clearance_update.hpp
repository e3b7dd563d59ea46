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

/// Cells that are occupied on one map and not on another.
struct OccupiedChange {
  std::vector<std::uint32_t> come, gone;
};

/// clearance_m with kOccupiedOrUnknown (distance.hpp) of one map after the other: a map that has grown or was
/// corrected costs a comparison of its cells, and the transform around those that have changed.
/// Always equal to the transform of the whole map.
class ClearanceUpdate {
 public:
  ClearanceUpdate();
  ~ClearanceUpdate();
  ClearanceUpdate(const ClearanceUpdate&) = delete;
  ClearanceUpdate& operator=(const ClearanceUpdate&) = delete;

  void take(const DenseMap& map);
  /// The same without the comparison: `others` has all cells that are not as on the map taken before. Of no
  /// meaning when that had another box.
  void take(const DenseMap& map, const CellBlocks& others);

  /// Of the map taken last; as long as its cells. Good until the next take().
  [[nodiscard]] const std::vector<float>& clearance_m() const;

  /// Cells of the map taken last whose clearance is not what it was on the map before it, ascending; what was
  /// outside of that map had none. Nothing when it was another map: of another resolution, or with a box that
  /// is not inside this one's. Good until the next take().
  [[nodiscard]] const std::optional<std::vector<std::uint32_t>>& changed() const;

  /// Of the map taken last, as against the one before it; of no meaning when that had another box. Good until
  /// the next take().
  [[nodiscard]] const OccupiedChange& occupied() const;

 private:
  struct Impl;
  void take(const DenseMap& map, const CellBlocks* others);
  std::unique_ptr<Impl> impl_;
};

}  // namespace topo::grid

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::grid {

/// What bounds free space.
enum class Boundary : std::uint8_t {
  kOccupied,           ///< unknown is open
  kOccupiedOrUnknown,  ///< only what was seen to be free is open
};

/// Of a map in cells: 1.6 km of 0.05 m.
inline constexpr int kMaxSide = 32765;

/// Exact Euclidean distance from every cell's centre to the centre of the nearest boundary cell, in metres:
/// 0 on boundary cells. Linear time (Meijster, Roerdink and Hesselink 2000; Felzenszwalb and Huttenlocher
/// 2012). As long as map.cells. What lies outside the array is boundary only for kOccupiedOrUnknown. Infinity
/// where there is no boundary at all. Precondition: at most kMaxSide cells a side.
std::vector<float> clearance_m(const DenseMap& map, Boundary boundary);

/// clearance_m with kOccupiedOrUnknown of one map after the other: a map that has grown or was corrected
/// costs a pass over its cells for what it has in common with the one before, and the transform for what it
/// has not. Always equal to the transform of the whole map. Keeps two versions.
class ClearanceUpdate {
 public:
  ClearanceUpdate();
  ~ClearanceUpdate();
  ClearanceUpdate(const ClearanceUpdate&) = delete;
  ClearanceUpdate& operator=(const ClearanceUpdate&) = delete;

  void take(const DenseMap& map);

  /// Of the map taken last; as long as its cells. Good until the next take().
  [[nodiscard]] const std::vector<float>& clearance_m() const;

  /// Cells of the map taken last whose clearance is not what it was on the map before it, ascending; what was
  /// outside of that map had none. Nothing when it was another map: of another resolution, or with a box that
  /// is not inside this one's. Good until the next take().
  [[nodiscard]] const std::optional<std::vector<std::uint32_t>>& changed() const;

 private:
  struct Version;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace topo::grid

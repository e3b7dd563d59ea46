// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::grid {

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

  /// Clearance of each cell of the last map. Valid until the next take().
  [[nodiscard]] const std::vector<float>& clearance_m() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace topo::grid

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/types/scan.hpp"
#include "core/types/se2.hpp"
#include "core/walls/column_params.hpp"
#include "core/walls/coronal_mount.hpp"
#include "core/walls/height_column.hpp"

namespace topo::walls {

/// Collects the hits of the coronal laser between two keyframes, as height columns in odom. A standing robot
/// adds nothing, so that memory is bounded by the distance and angle travelled since the collector was
/// emptied.
class ColumnCollector {
 public:
  explicit ColumnCollector(const CoronalMount& mount, const ColumnParams& params = {})
      : mount_(mount), params_(params) {}

  /// One coronal scan; poses of base_link in odom at its first and last beam.
  void add(const types::Scan& scan, const types::Se2& T_odom_first, const types::Se2& T_odom_last);

  /// Returns the collected columns, one per cell of ColumnParams::cell_m, in the frame of the given
  /// transform; empties the collector.
  [[nodiscard]] std::vector<ColumnPoint> take(const types::Se2& T_base_odom);

  /// Discards the collected columns. Without a keyframe that takes them, they would be placed later by an
  /// odometry that has drifted since.
  void drop() { columns_odom_.clear(); }

 private:
  CoronalMount mount_;
  ColumnParams params_;
  std::vector<ColumnPoint> columns_odom_;
  bool used_ = false;
  types::Se2 last_used_;
};

}  // namespace topo::walls

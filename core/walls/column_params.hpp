// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::walls {

/// Which hits of the coronal scanner become height columns. The values follow from the resolution of the map
/// (0.05 m).
struct ColumnParams {
  double step_m = 0.01;     ///< a scan adds information after this motion of the base: a fifth of a cell,
  double step_rad = 0.005;  ///< or after this turn: a fifth of a cell at 2 m
  float cell_m = 0.05F;     ///< columns within one such cell are merged: that of the map
};

}  // namespace topo::walls

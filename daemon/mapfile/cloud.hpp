// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "core/walls/wall_store.hpp"

namespace topo::daemon {

struct CloudPoint {
  float x_m = 0.0F;
  float y_m = 0.0F;
  float z_m = 0.0F;
  friend bool operator==(const CloudPoint&, const CloudPoint&) = default;
};

/// One point, in map, for each height slab observed in a cell: the centre of cell and slab.
[[nodiscard]] std::vector<CloudPoint> cloud_of(const walls::WallStore& walls);

/// Writes a PLY file (binary, little-endian: x y z as float), atomically. Blocks on the disk. Errors name the
/// file.
types::Status save_cloud(const std::string& path, std::span<const CloudPoint> points);

}  // namespace topo::daemon

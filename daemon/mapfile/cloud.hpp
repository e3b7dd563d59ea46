// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
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

/// One point for each height slab that was seen in a cell: the middle of both, in map.
[[nodiscard]] std::vector<CloudPoint> cloud_of(const walls::WallStore& walls);

/// The bytes of a PLY file (binary, little-endian): x y z as float, and intensity when it is given, one a
/// point.
[[nodiscard]] std::vector<std::byte> encode_ply(
    std::span<const CloudPoint> points, std::optional<std::span<const float>> intensity = std::nullopt);

/// Writes the file as a whole or not at all. Blocks on the disk. Errors name the file.
types::Status save_cloud(const std::string& path, std::span<const CloudPoint> points);

}  // namespace topo::daemon

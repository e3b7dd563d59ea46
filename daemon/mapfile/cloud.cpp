// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/cloud.hpp"

#include <fmt/format.h>

#include <bit>

#include "core/patricia/cell_key.hpp"
#include "daemon/mapfile/atomic_file.hpp"

namespace topo::daemon {

// A point in memory is a vertex of the file.
static_assert(std::endian::native == std::endian::little && sizeof(CloudPoint) == 3 * sizeof(float));

std::vector<CloudPoint> cloud_of(const walls::WallStore& walls) {
  std::size_t count = 0;
  walls.columns().for_each([&count](patricia::Key, walls::Slabs slabs) {
    count += static_cast<std::size_t>(std::popcount(slabs));
  });
  std::vector<CloudPoint> points;
  points.reserve(count);
  walls.columns().for_each([&](patricia::Key key, walls::Slabs slabs) {
    const patricia::Cell cell = patricia::cell_of(key);
    const auto centre = [&](std::int32_t i) { return static_cast<float>((i + 0.5) * walls.resolution_m()); };
    for (; slabs != 0; slabs &= slabs - 1) {
      const double height_m = (std::countr_zero(slabs) + 0.5) * walls::kSlabHeight_m;
      points.push_back({centre(cell.x), centre(cell.y), static_cast<float>(height_m)});
    }
  });
  return points;
}

types::Status save_cloud(const std::string& path, std::span<const CloudPoint> points) {
  const std::string head = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment topometric, metres, frame map\nelement vertex "
      "{}\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n",
      points.size());
  const FileContent file{path, std::as_bytes(std::span(head)), std::as_bytes(points)};
  return write_files({&file, 1});
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/cloud.hpp"

#include <fmt/format.h>

#include <bit>

#include "core/patricia/cell_key.hpp"
#include "daemon/mapfile/atomic_file.hpp"

namespace topo::daemon {

namespace {

void append_float(std::vector<std::byte>& out, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8)
    out.push_back(static_cast<std::byte>((bits >> shift) & 0xFFU));
}

}  // namespace

std::vector<CloudPoint> cloud_of(const walls::WallStore& walls) {
  std::vector<CloudPoint> points;
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

std::vector<std::byte> encode_ply(std::span<const CloudPoint> points,
                                  std::optional<std::span<const float>> intensity) {
  const std::string head = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment topometric, metres, frame map\nelement vertex "
      "{}\nproperty float x\n"
      "property float y\nproperty float z\n{}end_header\n",
      points.size(), intensity.has_value() ? "property float intensity\n" : "");
  std::vector<std::byte> out;
  out.reserve(head.size() + points.size() * 16);
  const auto head_bytes = std::as_bytes(std::span(head));
  out.insert(out.end(), head_bytes.begin(), head_bytes.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const float value : {points[i].x_m, points[i].y_m, points[i].z_m}) append_float(out, value);
    if (intensity.has_value()) append_float(out, i < intensity->size() ? (*intensity)[i] : 0.0F);
  }
  return out;
}

types::Status save_cloud(const std::string& path, std::span<const CloudPoint> points) {
  return write_file(path, encode_ply(points));
}

}  // namespace topo::daemon

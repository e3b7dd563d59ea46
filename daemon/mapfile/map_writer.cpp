// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/mapfile/map_image.hpp"

namespace topo::daemon {

using types::Status;

namespace {

constexpr std::byte grey_of(MapCell cell) {
  switch (cell) {  // the values that map_saver writes
    case MapCell::kFree:
      return std::byte{254};
    case MapCell::kOccupied:
      return std::byte{0};
    case MapCell::kUnknown:
      break;
  }
  return std::byte{205};
}

/// Formats without exponent: some YAML readers take a number such as 1e-07 for text.
std::string decimal(double value) {
  std::string text = fmt::format("{:.9f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text += '0';
  return text == "-0.0" ? "0.0" : text;
}

}  // namespace

std::vector<std::byte> encode_pgm(const MapImage& map) {
  const std::string head = fmt::format("P5\n# CREATOR: topometric {:.3f} m/pix\n{} {}\n255\n",
                                       map.resolution_m, map.width, map.height);
  std::vector<std::byte> out;
  out.reserve(head.size() + map.cells.size());
  const auto head_bytes = std::as_bytes(std::span(head));
  out.insert(out.end(), head_bytes.begin(), head_bytes.end());
  for (int y = map.height - 1; y >= 0; --y) {
    for (int x = 0; x < map.width; ++x) out.push_back(grey_of(map.at(x, y)));
  }
  return out;
}

std::string encode_map_yaml(const MapImage& map, const std::string& image_name) {
  return fmt::format(
      "image: {}\nmode: trinary\nresolution: {}\norigin: [{}, {}, {}]\nnegate: 0\noccupied_thresh: "
      "0.65\nfree_thresh: 0.196\n",
      image_name, decimal(map.resolution_m), decimal(map.origin.x_m), decimal(map.origin.y_m),
      decimal(map.origin.theta_rad));
}

Status save_map(const std::string& folder, const MapImage& map) {
  const std::vector<std::byte> pgm = encode_pgm(map);
  const std::string yaml = encode_map_yaml(map, "map.pgm");
  const FileContent files[] = {{folder + "/map.pgm", pgm},
                               {folder + "/map.yaml", std::as_bytes(std::span(yaml))}};
  return write_files(files);
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/map_input.hpp"

#include <fmt/format.h>

#include <cmath>

#include "daemon/mapfile/grey_image.hpp"
#include "daemon/mapfile/input_file.hpp"
#include "daemon/mapfile/map_image.hpp"

namespace topo::bench {
namespace {

using daemon::MapCell;
using grid::CellIndex;
using grid::CellState;
using types::Result;

constexpr std::size_t kMaxImageBytes = std::size_t{1} << 29U;

MapCell cell_of(double shade) {
  constexpr double kFree = 250.0, kNotOccupied = 89.0;  // map_server's 0.65; "under 250 not free"
  const double grey = std::round(255.0 * shade);
  return grey >= kFree ? MapCell::kFree : grey < kNotOccupied ? MapCell::kOccupied : MapCell::kUnknown;
}

Result<daemon::MapImage> read_picture(const std::string& path, double resolution_m) {
  if (!(resolution_m >= 0.001 && resolution_m <= 10.0)) {
    return types::fail(
        types::Errc::kInvalidInput,
        fmt::format("--resolution: found {}, expected metres a pixel from 0.001 to 10", resolution_m));
  }
  const auto content = daemon::read_file(path, kMaxImageBytes);
  if (!content) return tl::unexpected(content.error());
  const auto image = content->starts_with("\x89PNG") ? daemon::decode_png(path, *content)
                                                     : daemon::decode_pgm(path, *content);
  if (!image) return tl::unexpected(image.error());
  daemon::MapImage map{
      image->width, image->height, resolution_m, {}, std::vector<MapCell>(image->pixels.size()), {}};
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t from = map.index(x, map.height - 1 - y);
      const bool empty = !image->transparent.empty() && image->transparent[from];
      map.cells[map.index(x, y)] = empty ? MapCell::kUnknown : cell_of(image->shade(from));
    }
  }
  return map;
}

/// Cuts out what is known.
grid::DenseMap dense_of(const daemon::MapImage& image) {
  grid::DenseMap map;
  map.resolution_m = image.resolution_m;
  grid::CellBox known;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) != MapCell::kUnknown) known.extend(CellIndex{x, y});
    }
  }
  if (known.empty()) return map;
  map.box = {{known.min.x - 1, known.min.y - 1}, {known.max.x + 1, known.max.y + 1}};
  map.cells.assign(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()),
                   CellState::kUnknown);
  for (int y = known.min.y; y <= known.max.y; ++y) {
    for (int x = known.min.x; x <= known.max.x; ++x) {
      const MapCell cell = image.at(x, y);
      if (cell != MapCell::kUnknown)
        map.cells[map.index({x, y})] = cell == MapCell::kFree ? CellState::kFree : CellState::kOccupied;
    }
  }
  return map;
}

}  // namespace

bool names_map_yaml(const std::string& path) { return path.ends_with(".yaml") || path.ends_with(".yml"); }

Result<MapInput> read_map_input(const std::string& path, double resolution_m) {
  const auto image = names_map_yaml(path) ? daemon::load_map(path) : read_picture(path, resolution_m);
  if (!image) return tl::unexpected(image.error());
  constexpr double kRounding_rad = 1e-6;
  if (std::abs(image->origin.theta_rad) > kRounding_rad) {
    return types::fail(types::Errc::kInvalidInput,
                       fmt::format("{}: key origin: found a yaw of {:g}, expected 0: the picture of a turned "
                                   "map is not that of its places",
                                   path, image->origin.theta_rad));
  }
  return MapInput{dense_of(*image), image->width, image->height, image->origin.translation(),
                  image->warnings};
}

void print_warnings(const std::string& path, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "topobench: {}: {}\n", path, warning);
}

}  // namespace topo::bench

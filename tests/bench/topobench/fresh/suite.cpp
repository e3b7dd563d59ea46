// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/suite.hpp"

#include <fmt/format.h>

#include "daemon/mapfile/atomic_file.hpp"
#include "tests/sim/image_file.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench::fresh {
namespace {

namespace fs = std::filesystem;
using types::Errc;
using types::fail;

constexpr std::uint64_t kBuildingStream = 41;
constexpr std::uint8_t kFreeGrey = 254, kWallGrey = 0, kUnknownGrey = 205;
constexpr int kWallCells = 2;  // so far behind its surface a wall is known

bool is_near_free(const sim::Raster& free, int x, int y) {
  for (int dy = -kWallCells; dy <= kWallCells; ++dy) {
    for (int dx = -kWallCells; dx <= kWallCells; ++dx) {
      if (free.at(x + dx, y + dy) != 0) return true;
    }
  }
  return false;
}

sim::GreyImage image_of(const sim::Raster& free) {
  sim::GreyImage image{free.width, free.height, {}};
  image.pixels.reserve(free.cells.size());
  for (int y = free.height - 1; y >= 0; --y) {
    for (int x = 0; x < free.width; ++x)
      image.pixels.push_back(free.at(x, y) != 0         ? kFreeGrey
                             : is_near_free(free, x, y) ? kWallGrey
                                                        : kUnknownGrey);
  }
  return image;
}

}  // namespace

std::uint64_t seed_of_building(std::uint64_t suite_seed, int building) {
  return sim::derive_seed(suite_seed, kBuildingStream, static_cast<std::uint64_t>(building));
}

types::Status write_building(const Building& building, const fs::path& yaml) {
  fs::path png = yaml;
  png.replace_extension(".png");
  if (auto written = sim::write_png(image_of(building.free), png); !written) return written;
  const sim::Se2& start = building.start;
  return daemon::write_file(
      yaml.string(),
      fmt::format("image: {}\nresolution: {}\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n"
                  "occupied_thresh: 0.65\nfree_thresh: 0.196\nstart: [{:.3f}, {:.3f}, {:.3f}]\n",
                  png.filename().string(), building.free.resolution_m, start.x_m, start.y_m,
                  start.theta_rad));
}

types::Result<std::vector<fs::path>> write_fresh_suite(std::uint64_t suite_seed, int buildings,
                                                       const fs::path& folder) {
  if (buildings < 1 || buildings > kSuiteMax)
    return fail(Errc::kInvalidInput,
                fmt::format("--buildings: found {}, expected 1 to {}", buildings, kSuiteMax));
  std::vector<fs::path> files;
  for (int i = 1; i <= buildings; ++i) {
    const auto building = draw_building(seed_of_building(suite_seed, i));
    if (!building) return tl::unexpected(building.error());
    files.push_back(folder / fmt::format("fresh-{}-{:02d}.yaml", suite_seed, i));
    if (auto written = write_building(*building, files.back()); !written)
      return tl::unexpected(written.error());
  }
  return files;
}

types::Result<std::vector<fs::path>> dev_suite(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const char* name : kDevPlans) {
    files.push_back(folder / fmt::format("{}.yaml", name));
    std::error_code error;
    if (!fs::exists(files.back(), error))
      return fail(Errc::kNotFound,
                  fmt::format("--suite dev: found no {}, expected the sixteen public plans in --worlds",
                              files.back().string()));
  }
  return files;
}

}  // namespace topo::bench::fresh

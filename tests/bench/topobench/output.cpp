// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/output.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/mapfile/map_image.hpp"
#include "daemon/mapfile/picture.hpp"

namespace topo::bench {
namespace {

constexpr daemon::Rgb kPathColour{30, 90, 220};
constexpr daemon::Rgb kClosureColour{230, 60, 40};

std::string trajectory_text(const MappingRun& run) {
  std::string text;
  for (const TimedPose& timed : run.trajectory) {
    fmt::format_to(std::back_inserter(text), "{:.6f} {:.6f} {:.6f} {:.7f}\n", timed.stamp_s, timed.pose.x_m,
                   timed.pose.y_m, timed.pose.theta_rad);
  }
  return text;
}

}  // namespace

double peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

types::Status make_folder(const std::filesystem::path& folder) {
  if (folder.empty()) return {};
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && ::access(folder.c_str(), W_OK | X_OK) != 0) error = {errno, std::generic_category()};
  if (!error) return {};
  return types::fail(types::Errc::kPermission,
                     fmt::format("{}: cannot make the folder for the results, or files in it: {}",
                                 folder.string(), error.message()),
                     error.value());
}

types::Status write_map(const std::filesystem::path& folder, const pipeline::MapSnapshot& map) {
  const auto image = daemon::image_of(map.grid);
  if (!image) return tl::unexpected(image.error());
  return daemon::save_map(folder.string(), *image);
}

types::Status write_map_files(const std::filesystem::path& folder, const pipeline::MapSnapshot& map,
                              const slam::Mapper& mapper, const MappingRun& run) {
  const auto image = daemon::image_of(map.grid);
  if (!image) return tl::unexpected(image.error());
  if (auto saved = daemon::save_map(folder.string(), *image); !saved) return saved;
  daemon::Picture picture = daemon::picture_of(*image);
  for (const slam::Edge& edge : mapper.edges()) {
    if (!edge.robust) continue;
    const std::array<types::Se2, 2> ends{mapper.poses()[edge.from], mapper.poses()[edge.to]};
    daemon::draw_path(picture, *image, ends, kClosureColour);
  }
  std::vector<types::Se2> path;
  for (const TimedPose& timed : run.trajectory) path.push_back(timed.pose);
  daemon::draw_path(picture, *image, path, kPathColour);
  if (auto saved = daemon::save_png((folder / "map.png").string(), picture); !saved) return saved;
  return daemon::write_file((folder / "trajectory.txt").string(), trajectory_text(run));
}

}  // namespace topo::bench

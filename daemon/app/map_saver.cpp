// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/map_saver.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "daemon/app/json/plan_json.hpp"
#include "daemon/mapfile/atomic_file.hpp"
#include "daemon/mapfile/cloud.hpp"
#include "daemon/mapfile/doubt_json.hpp"
#include "daemon/mapfile/map_image.hpp"
#include "daemon/mapfile/overview.hpp"
#include "daemon/mapfile/places_geojson.hpp"

namespace topo::daemon {
namespace {

/// Creates the folder itself, not its parents: a mistyped path must show as an error.
types::Status make_folder(const std::string& folder) {
  constexpr mode_t kMode = 0775;
  if (::mkdir(folder.c_str(), kMode) == 0 || errno == EEXIST) return {};
  return types::fail(types::Errc::kInvalidInput,
                     fmt::format("{}: cannot make the folder: {}", folder, std::strerror(errno)), errno);
}

/// The path through the keyframes as text, one line each: stamp on CLOCK_MONOTONIC, x, y, theta of the robot
/// in map.
std::string trajectory_text(const pipeline::MapSnapshot& map) {
  std::string text;
  for (const types::KeyframePose& keyframe : map.keyframes) {
    fmt::format_to(std::back_inserter(text), "{:.6f} {:.6f} {:.6f} {:.7f}\n",
                   types::to_seconds(keyframe.stamp), keyframe.T_map_base.x_m(), keyframe.T_map_base.y_m(),
                   keyframe.T_map_base.theta_rad());
  }
  return text;
}

/// Writes the walls as a cloud. Returns how many points.
types::Result<std::size_t> save_walls(const std::string& folder, const walls::WallStore& walls) {
  const auto cloud = cloud_of(walls);
  if (const auto saved = save_cloud(folder + "/cloud.ply", cloud); !saved)
    return tl::unexpected(saved.error());
  return cloud.size();
}

}  // namespace

types::Result<SavedMap> MapSaver::save(const std::string& folder, const FoundDoubt* doubt) {
  const auto snapshot = snapshots_.pin();
  if (!snapshot || snapshot->keyframes.empty()) {
    return types::fail(types::Errc::kNotFound, "there is no map yet: no scan was matched since the start");
  }
  const auto image = image_of(snapshot->grid);
  if (!image) return tl::unexpected(image.error());
  if (const auto made = make_folder(folder); !made) return tl::unexpected(made.error());
  if (const auto saved = save_map(folder, *image); !saved) return tl::unexpected(saved.error());
  const auto points = save_walls(folder, snapshot->walls);
  if (!points) return tl::unexpected(points.error());
  if (const auto saved = write_file(folder + "/trajectory.txt", trajectory_text(*snapshot)); !saved)
    return tl::unexpected(saved.error());
  SavedMap saved{folder, snapshot->revision, image->width, image->height, *points, 0, 0, {}};
  if (doubt != nullptr) {
    saved.doubted = doubt_text(doubt->doubt);
    if (const auto written = write_file(folder + "/doubt.json", doubt_json(*doubt).dump(1) + "\n"); !written)
      return tl::unexpected(written.error());
  }
  if (const auto analysed = save_analysis(folder, *snapshot, doubt, saved); !analysed)
    return tl::unexpected(analysed.error());
  return saved;
}

/// Writes planning's analysis of the map; nothing before the first analysis.
types::Status MapSaver::save_analysis(const std::string& folder, const pipeline::MapSnapshot& map,
                                      const FoundDoubt* doubt, SavedMap& saved) {
  const auto report = reports_.pin();
  if (!report || report->analysis == nullptr) return {};
  saved.places = report->analysis->places.places.size();
  saved.goals = report->open_goals.size();
  std::vector<types::Se2> way;
  way.reserve(map.keyframes.size());
  for (const types::KeyframePose& keyframe : map.keyframes) way.push_back(keyframe.T_map_base.se2());
  if (auto s = write_file(folder + "/goals.json", goals_json(*report).dump(1) + "\n"); !s) return s;
  if (auto s = write_file(folder + "/places.geojson", places_geojson(*report->analysis, report->open_goals));
      !s) {
    return s;
  }
  std::vector<slam::RevisitRegion> doubted;
  if (doubt != nullptr) doubted = doubt->doubt.regions;
  return save_png(folder + "/overview.png", overview_of(*report->analysis, way, report->open_goals, doubted));
}

}  // namespace topo::daemon

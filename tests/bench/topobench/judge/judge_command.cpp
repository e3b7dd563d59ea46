// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/judge/judge_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "daemon/mapfile/map_image.hpp"
#include "tests/bench/topobench/analyse/map_input.hpp"
#include "tests/bench/topobench/explore/explore_run.hpp"
#include "tests/bench/topobench/judge/path_error.hpp"
#include "tests/bench/topobench/judge/pose_file.hpp"
#include "tests/bench/topobench/overview.hpp"
#include "tests/sim/area.hpp"

namespace topo::bench {
namespace {

using nlohmann::json;

struct Covered {
  sim::Raster free;  ///< 1 where a cell of the area is known as free
  std::size_t area = 0, free_cells = 0, known_cells = 0;
};

Covered cover(const sim::Raster& visible, const daemon::MapImage& map, const types::Se2& T_building_map) {
  Covered covered{sim::Raster(visible.resolution_m, visible.origin, visible.width, visible.height)};
  const types::Se2 T_image_building = (T_building_map * map.origin).inverse();
  for (int y = 0; y < visible.height; ++y) {
    for (int x = 0; x < visible.width; ++x) {
      if (visible.at(x, y) == 0) continue;
      ++covered.area;
      const types::Vector2 p = T_image_building * visible.center(x, y);
      const double column = std::floor(p.x() / map.resolution_m), row = std::floor(p.y() / map.resolution_m);
      if (column < 0 || row < 0 || column >= map.width || row >= map.height) continue;
      const daemon::MapCell cell = map.at(static_cast<int>(column), static_cast<int>(row));
      if (cell == daemon::MapCell::kUnknown) continue;
      ++covered.known_cells;
      if (cell != daemon::MapCell::kFree) continue;
      ++covered.free_cells;
      covered.free.set(x, y, 1);
    }
  }
  return covered;
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

double length_m(const std::vector<TimedPose>& poses) {
  double length = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    length += (poses[i].pose.translation() - poses[i - 1].pose.translation()).norm();
  return length;
}

/// Nothing when there is no trajectory beside the map.
types::Result<std::vector<PosePair>> read_pairs(const JudgeCommand& command,
                                                const std::vector<TimedPose>& truth) {
  const auto path = std::filesystem::path(command.map).parent_path() / "trajectory.txt";
  if (!std::filesystem::exists(path)) return std::vector<PosePair>{};
  const auto trajectory = read_poses(path.string());
  if (!trajectory) return tl::unexpected(trajectory.error());
  auto pairs = pair_up(*trajectory, truth);
  if (pairs.empty()) {
    return types::fail(
        types::Errc::kInvalidInput,
        fmt::format("{}: found no stamp from {:.3f} to {:.3f} s, where {} has the truth; expected "
                    "files of one run",
                    path.string(), truth.front().stamp_s, truth.back().stamp_s, command.truth));
  }
  return pairs;
}

void add_path_errors(json& report, const std::vector<PosePair>& pairs, const types::Se2& T_building_map) {
  if (pairs.empty()) return;
  const PathError at_start = path_error(pairs, T_building_map), fitted = path_error(pairs, best_fit(pairs));
  report["poses"] = pairs.size();
  report["ate_rmse_m"] = at_start.rmse_m;
  report["ate_worst_m"] = at_start.worst_m;
  report["ate_fitted_rmse_m"] = fitted.rmse_m;
  report["ate_fitted_worst_m"] = fitted.worst_m;
}

/// Where the map lies in the building. Its own frame is the first pose, whose heading is no better than one
/// scan: 0.3 degrees there are 0.2 m at the far end of a floor that is right in itself. So the map is laid on
/// the truth as its path fits best, as path errors are reported too; a path too short to tell stays at the
/// start.
types::Se2 place_of_map(const std::vector<PosePair>& pairs, const std::vector<TimedPose>& truth,
                        const types::Se2& start) {
  constexpr double kLongEnough_m = 10.0;
  return pairs.size() < 10 || length_m(truth) < kLongEnough_m ? start : best_fit(pairs);
}

types::Status save_picture(const JudgeCommand& command, const sim::World& world, const sim::Raster& visible,
                           const Covered& covered, const std::vector<TimedPose>& truth) {
  std::vector<sim::Se2> path;
  path.reserve(truth.size());
  for (const TimedPose& pose : truth) path.push_back(pose.pose);
  return overview(world, {visible, covered.free, path, {}}).save_png(command.picture);
}

}  // namespace

types::Status run_judge(const JudgeCommand& command) {
  if (!command.start.empty() && command.start.size() != 3)
    return types::fail(types::Errc::kInvalidInput, "--start: expected X,Y,THETA in metres and radians");
  const auto world = sim::World::load(command.world);
  if (!world) return tl::unexpected(world.error());
  const auto map = daemon::load_map(command.map);
  if (!map) return tl::unexpected(map.error());
  print_warnings(command.map, map->warnings);
  const auto truth = read_poses(command.truth);
  if (!truth) return tl::unexpected(truth.error());
  const auto pairs = read_pairs(command, *truth);
  if (!pairs) return tl::unexpected(pairs.error());

  const auto& s = command.start;
  const types::Se2 start = s.empty() ? truth->front().pose : types::Se2{s[0], s[1], s[2]};
  const sim::Raster visible =
      reachable_area(*world, truth->front().pose.translation(), sim::RobotModel::p3dx().swing_radius_m)
          .visible;
  const Covered at_start = cover(visible, *map, start);
  const Covered covered = cover(visible, *map, place_of_map(*pairs, *truth, start));
  const double home_m = (truth->back().pose.translation() - truth->front().pose.translation()).norm();
  json report{{"world", command.world.stem().string()},
              {"robots", 1},
              {"reachable_m2", visible.area_m2()},
              {"covered", share(covered.free_cells, covered.area)},
              {"covered_at_start", share(at_start.free_cells, at_start.area)},
              {"known", share(covered.known_cells, covered.area)},
              {"distance_m", {length_m(*truth)}},
              {"home", {home_m <= kHome_m}},
              {"home_distance_m", home_m},
              {"end_s", truth->back().stamp_s - truth->front().stamp_s}};
  add_path_errors(report, *pairs, start);
  if (!command.picture.empty()) {
    if (auto saved = save_picture(command, *world, visible, covered, *truth); !saved) return saved;
  }
  fmt::print("{}\n", command.json ? report.dump() : report.dump(2));
  return {};
}

}  // namespace topo::bench

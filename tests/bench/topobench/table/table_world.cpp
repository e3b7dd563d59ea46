// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/table_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>

#include "tests/bench/topobench/explore/explore_run.hpp"
#include "tests/bench/topobench/table/fingerprint.hpp"
#include "tests/sim/area.hpp"
#include "tests/sim/random.hpp"
#include "tests/sim/robot_model.hpp"
#include "tests/sim/team_start.hpp"

namespace topo::bench {
namespace {

namespace fs = std::filesystem;
using types::Errc;
using types::fail;

constexpr int kTriesMax = 10000;
constexpr std::uint64_t kStartStream = 21;  // of the seed's random numbers

bool is_world(const fs::path& file) {
  const fs::path extension = file.extension();
  return extension == ".yaml" || extension == ".yml" || extension == ".toml";
}

std::vector<std::string> columns_of(const std::string& line) {
  std::vector<std::string> columns;
  std::istringstream in(line);
  for (std::string column; std::getline(in, column, '\t');) columns.push_back(column);
  return columns;
}

std::optional<double> number_of(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The world's line in the list beside it; nothing when there is no list, or no such line in it.
types::Result<std::optional<sim::Se2>> listed_start(const fs::path& world) {
  const fs::path list = world.parent_path() / "WORLDS.tsv";
  std::ifstream in(list);
  std::string line;
  if (!in || !std::getline(in, line)) return std::nullopt;
  const std::vector<std::string> header = columns_of(line);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  const std::size_t name = column("name"), x = column("start_x_m"), y = column("start_y_m");
  const std::size_t last = std::max({name, x, y});
  if (last >= header.size())
    return fail(Errc::kInvalidInput,
                fmt::format("{}: found the columns '{}', expected name, start_x_m and start_y_m among them, "
                            "separated by tabs",
                            list.string(), line));
  while (std::getline(in, line)) {
    const std::vector<std::string> columns = columns_of(line);
    if (columns.size() <= name || columns[name] != world.stem()) continue;
    const auto x_m = last < columns.size() ? number_of(columns[x]) : std::nullopt;
    const auto y_m = last < columns.size() ? number_of(columns[y]) : std::nullopt;
    if (x_m && y_m) return sim::Se2{*x_m, *y_m, 0.0};
    return fail(Errc::kInvalidInput, fmt::format("{}: {}: expected metres in start_x_m and start_y_m",
                                                 list.string(), columns[name]));
  }
  return std::nullopt;
}

/// What a robot gets through for sure: the disc that its routes need, and a cell for the map's errors.
double sure_radius_m() {
  const MindSetup mind = default_setup({}, 1, Fidelity::kPlan).mind;
  return mind.planner.travel.radius_m + mind.mapping.grid.resolution_m;
}

double to_thousandths(double value) { return std::round(value * 1e3) / 1e3; }

}  // namespace

types::Result<std::vector<fs::path>> world_files(std::span<const fs::path> files_and_folders) {
  std::vector<fs::path> files;
  for (const fs::path& given : files_and_folders) {
    std::error_code error;
    if (!fs::is_directory(given, error)) {
      files.push_back(given);
      continue;
    }
    const std::size_t before = files.size();
    for (const auto& entry : fs::directory_iterator(given, error)) {
      if (is_world(entry.path())) files.push_back(entry.path());
    }
    if (error || files.size() == before)
      return fail(Errc::kNotFound,
                  fmt::format("{}: found no worlds in it, expected .yaml or .toml", given.string()));
  }
  const auto by_name = [](const fs::path& a, const fs::path& b) { return a.stem() < b.stem(); };
  std::sort(files.begin(), files.end(), by_name);
  const auto same = std::adjacent_find(
      files.begin(), files.end(), [](const fs::path& a, const fs::path& b) { return a.stem() == b.stem(); });
  if (same != files.end())
    return fail(Errc::kInvalidInput, fmt::format("{} and {} have the same name, expected different ones",
                                                 same->string(), std::next(same)->string()));
  return files;
}

types::Result<sim::Se2> own_start(const fs::path& file, const sim::World& world) {
  const auto listed = listed_start(file);
  if (!listed) return tl::unexpected(listed.error());
  return listed->value_or(world.start_poses().front());
}

types::Result<sim::Se2> start_of_seed(const sim::World& world, const sim::Raster& poses, const sim::Se2& own,
                                      std::uint64_t seed) {
  if (seed == 1) return own;
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < poses.cells.size(); ++i) {
    if (poses.cells[i] != 0) cells.push_back(i);
  }
  sim::Random random(sim::derive_seed(seed, kStartStream));
  for (int i = 0; i < kTriesMax && !cells.empty(); ++i) {
    const std::size_t cell = cells[random.next() % cells.size()];
    const auto width = static_cast<std::size_t>(poses.width);
    const types::Vector2 p = poses.center(static_cast<int>(cell % width), static_cast<int>(cell / width));
    const sim::Se2 start{to_thousandths(p.x()), to_thousandths(p.y()),
                         to_thousandths(random.uniform(-std::numbers::pi, std::numbers::pi))};
    if (sim::has_room(world, start) && sim::team_starts(world, start, kStartTeam)) return start;
  }
  return fail(Errc::kInvalidInput, fmt::format("world '{}': found no start for seed {}, expected room for {} "
                                               "robots somewhere that one gets to from ({:.2f}, {:.2f})",
                                               world.name(), seed, kStartTeam, own.x_m, own.y_m));
}

types::Result<TableWorld> load_table_world(const fs::path& file, int seeds, bool drawn, int team) {
  const auto world = sim::World::load(file);
  if (!world) return tl::unexpected(world.error());
  const auto start_there = own_start(file, *world);
  if (!start_there) return tl::unexpected(start_there.error());
  const sim::Se2 own = *start_there;
  const sim::ReachableArea area =
      reachable_area(*world, own.translation(), sim::RobotModel::p3dx().swing_radius_m);
  const sim::Raster poses = sim::reachable_poses(world->structure(), own.translation(), sure_radius_m());
  TableWorld out{file, file.stem().string(), fingerprint_of(*world), area.visible.area_m2(), {}};
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto start =
        start_of_seed(*world, poses, own, drawn ? static_cast<std::uint64_t>(seed) : std::uint64_t{1});
    if (!start) return tl::unexpected(start.error());
    if (const auto room = sim::team_starts(*world, *start, team); !room) return tl::unexpected(room.error());
    out.starts.push_back(*start);
  }
  return out;
}

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "tests/sim/raster.hpp"
#include "tests/sim/world.hpp"

namespace topo::bench {

/// A building of a table of explorations.
struct TableWorld {
  std::filesystem::path file;
  std::string name;      ///< of the file, without its extension
  std::string building;  ///< fingerprint
  double reachable_m2 = 0.0;
  std::vector<sim::Se2> starts;  ///< of seeds 1, 2, ...
};

/// Robots that every drawn start has room for.
inline constexpr int kStartTeam = 3;

/// The worlds (.yaml, .toml) of files and folders, in the order of their names; a folder's file WORLDS.tsv is
/// not among them. Names must be different, since runs are told apart by them.
types::Result<std::vector<std::filesystem::path>> world_files(
    std::span<const std::filesystem::path> files_and_folders);

/// Where robots enter a world that was loaded from a file: its line in the file WORLDS.tsv beside it
/// (tab-separated, with a header that has name, start_x_m and start_y_m; heading 0), if there is one, else
/// the world's first.
types::Result<sim::Se2> own_start(const std::filesystem::path& file, const sim::World& world);

/// Where robots enter with a seed. Seed 1: `own`. Any other draws from the cells that a robot gets to from
/// `own` (`poses`, not 0), each as likely as another, and any heading, until kStartTeam robots have room
/// there, the first among them (team_start.hpp): a function of building, `own` and seed alone, however many
/// robots then start. To the millimetre and milliradian, so that `topobench explore --start` can say the
/// same.
types::Result<sim::Se2> start_of_seed(const sim::World& world, const sim::Raster& poses, const sim::Se2& own,
                                      std::uint64_t seed);

/// Loads a world. Starts are drawn where a robot gets to from its own one through passages that its planner
/// takes without doubt: whoever starts behind a narrower one never gets out, and tells nothing. Its own start
/// is own_start(). `seeds`: how many starts; all are the own one unless `drawn`. `team`: how many robots must
/// have room at each.
types::Result<TableWorld> load_table_world(const std::filesystem::path& file, int seeds, bool drawn,
                                           int team);

}  // namespace topo::bench

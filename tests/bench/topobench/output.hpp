// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "core/pipeline/map_snapshot.hpp"
#include "core/types/result.hpp"
#include "tests/bench/topobench/slam/lock_step.hpp"

namespace topo::bench {

/// The most memory this process ever held, in MiB (getrusage(2)).
double peak_rss_mb();

/// Makes the folder for results if it is missing, and sees to it that files can be made in it: before the
/// work, so that no half hour of it is lost. Nothing for an empty path: no results are wanted as files.
types::Status make_folder(const std::filesystem::path& folder);

/// map.pgm and map.yaml in an existing folder.
types::Status write_map(const std::filesystem::path& folder, const pipeline::MapSnapshot& map);

/// map.pgm, map.yaml, map.png (the trajectory blue, closures red) and trajectory.txt in an existing folder.
types::Status write_map_files(const std::filesystem::path& folder, const pipeline::MapSnapshot& map,
                              const slam::Mapper& mapper, const MappingRun& run);

}  // namespace topo::bench

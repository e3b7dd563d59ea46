// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "core/pipeline/map_snapshot.hpp"
#include "core/types/result.hpp"
#include "tests/bench/topobench/log_run.hpp"

namespace topo::bench {

/// map.pgm, map.yaml, map.png (with the trajectory) and trajectory.txt in a folder, which is made if missing.
types::Status write_map_files(const std::filesystem::path& folder, const pipeline::MapSnapshot& map,
                              const LogRun& run);

}  // namespace topo::bench

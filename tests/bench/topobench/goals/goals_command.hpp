// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::bench {

struct GoalsCommand {
  std::vector<std::filesystem::path> worlds;
  int seeds = 1;    ///< explorations a world, from drawn starts as explore-table has them
  int stages = 10;  ///< maps of each
  std::string fidelity = "plan";
  std::filesystem::path out;  ///< empty: no pictures
  bool json = false;
};

/// `topobench goals`: how few goals the analysis has on partial maps met while exploring, and whether one is
/// missing. Prints sums of clusters and goals over the maps with eight frontier clusters or more, of openings
/// over all maps, and each map; with `out` a picture of each map on which an opening is without a goal. All
/// worlds are read before the first is explored.
types::Status run_goals(const GoalsCommand& command);

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::bench {

struct JudgeCommand {
  std::filesystem::path world;
  std::string map;            ///< map.yaml; trajectory.txt is looked for beside it
  std::string truth;          ///< what toposim --truth wrote
  std::vector<double> start;  ///< x, y, theta of the map's origin in the building; empty: the first true pose
  std::filesystem::path picture;  ///< empty: none
  bool json = false;
};

/// `topobench judge`: a map that the daemon saved, held against the building and the way that the robot truly
/// went. Prints the keys of REPORTS "topobench explore" that apply, and the error of the path.
types::Status run_judge(const JudgeCommand& command);

}  // namespace topo::bench

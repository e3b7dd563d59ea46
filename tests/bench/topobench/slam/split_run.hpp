// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/topobench/slam/lock_step.hpp"

namespace topo::bench {

/// A log whose halves played two robots that set out together, as the first robot's map has it in the end.
struct SplitRun {
  std::vector<TimedPose> trajectory;    ///< every scan of both that is in the map
  std::size_t keyframes = 0;            ///< in the map
  std::size_t mates_keyframes = 0;      ///< of these, the second robot's
  std::optional<double> joined_share;   ///< of the second's scans, when the first of them entered
  int ties = 0;                         ///< relations between the two
  std::vector<std::string> alignments;  ///< what became of each search, either robot's
};

/// Both halves at once, scan by scan; every 20 scans each gets what is new of the other. At the end both
/// stand until nothing is open. `second_start`: where the second one starts in the first one's map, if they
/// know.
SplitRun run_split(const CarmenLog& log, const std::optional<types::Se2>& second_start);

}  // namespace topo::bench

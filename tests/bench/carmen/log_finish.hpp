// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/carmen/scanner_facts.hpp"

namespace topo::bench {

enum class Layout { kFlaser, kRobotLaser, kRawLaser };

/// The scans of one message, as its lines give them.
struct Sweeps {
  Layout layout = Layout::kFlaser;
  std::vector<CarmenScan> scans;
  std::optional<types::Error> error;      ///< of the first line that could not be read
  std::map<std::size_t, int> first_line;  ///< of each number of beams
  int two_fans = 0;                       ///< lines whose field of view and resolution contradict each other
};

/// What is known of those scans beside their lines.
struct SweepContext {
  const std::string& path;
  const std::string& message;
  const ScannerFacts& facts;
  const LogOptions& options;
};

/// Completes the scans by what their lines do not say (angles, reach, poses) and moves them to `log`, whose
/// odometry is there and sorted; adds its remarks. kInvalidInput when a line could not be read, when no known
/// scanner has that number of beams, and when scans without poses have no odometry around them.
types::Status finish_sweeps(const SweepContext& context, Sweeps& sweeps, CarmenLog& log);

}  // namespace topo::bench

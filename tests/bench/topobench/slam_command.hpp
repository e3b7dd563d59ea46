// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "tests/bench/topobench/slam/thinned_log.hpp"

namespace topo::bench {

struct SlamCommand {
  std::string log;                ///< empty: simulate
  std::vector<double> beams_deg;  ///< START and STEP of the log's beams; empty: the log's or its scanner's
  std::string relations;          ///< empty: none
  Thinning thinning;
  std::string split;               ///< of a log in halves: "known" or "unknown" starts; empty: not at all
  std::filesystem::path simulate;  ///< the building; empty: a log is read
  double minutes = 30.0;
  std::uint64_t seed = 1;
  int people = 0;
  double acceleration_mps2 = 0.5;
  double hardship = 1.0;      ///< of the simulated wheels
  std::string calibration;    ///< of calibration_names(): the robot of `topobench calibrate`; empty: another
  std::filesystem::path out;  ///< empty: no files
  bool json = false;
};

/// `topobench slam`: maps a log, or what a simulated robot measures on a patrol through a building; writes
/// the map and the trajectory, prints the report of REPORTS "topobench slam".
types::Status run_slam(const SlamCommand& command);

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "tests/sim/simulation.hpp"

namespace topo::sim {

/// Writes the true poses of the robots, one file per robot: `t x y theta` every 100 ms, tab-separated, t on
/// CLOCK_MONOTONIC. Comment lines begin with #.
class TruthRecorder {
 public:
  types::Status open(const std::filesystem::path& file, std::size_t robots, const std::string& difficulty);
  /// Writes every line that is due.
  void record(const Simulation& simulation, double epoch_s);

 private:
  std::vector<std::ofstream> files_;
  SimTime next_{0};
};

}  // namespace topo::sim

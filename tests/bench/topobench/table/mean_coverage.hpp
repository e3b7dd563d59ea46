// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/topobench/table/averages.hpp"
#include "tests/sim/picture.hpp"

namespace topo::bench {

/// The share of the area over time, in the mean of an entrant's runs.
struct MeanCoverage {
  Entrant entrant;
  std::size_t runs = 0;
  std::vector<std::pair<double, double>> coverage;  ///< every 5 s from 0 on
};

/// Share that a run had covered at a moment: what was noted last; 0 before the first, the last one's
/// afterwards.
double share_at(std::span<const std::pair<double, double>> coverage, double t_s);

/// Mean curves of the entrants, in their order, over the conditions (world and seed) that all of them have,
/// of one world, or of all with "". A run that crashed counts as 0 at all times. Up to the moment when the
/// longest of the runs is over.
std::vector<MeanCoverage> mean_coverage(std::span<const TableRun> runs, std::span<const Entrant> entrants,
                                        const std::string& world);

/// Curves in colours with a legend.
sim::Picture picture_of(std::span<const MeanCoverage> curves);

}  // namespace topo::bench

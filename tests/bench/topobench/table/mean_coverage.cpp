// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/mean_coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tests/bench/topobench/explore/coverage_plot.hpp"

namespace topo::bench {
namespace {

constexpr double kStep_s = 5.0;

// Hues that eyes tell apart that do not tell red from green (Okabe and Ito 2008), yellow darker for a white
// ground. The first entrant has the strongest.
constexpr std::array<sim::Colour, 8> kColours{{{213, 94, 0},
                                               {0, 114, 178},
                                               {0, 158, 115},
                                               {204, 121, 167},
                                               {86, 180, 233},
                                               {150, 120, 0},
                                               {230, 159, 0},
                                               {0, 0, 0}}};

using Condition = std::pair<std::string, std::uint64_t>;
using RunsOfEntrant = std::map<Condition, const TableRun*>;

/// Leaves what all have.
void keep_common(std::vector<RunsOfEntrant>& by_entrant) {
  for (RunsOfEntrant& runs : by_entrant) {
    std::erase_if(runs, [&](const auto& run) {
      return std::any_of(by_entrant.begin(), by_entrant.end(),
                         [&](const RunsOfEntrant& other) { return !other.contains(run.first); });
    });
  }
}

double end_of(const std::vector<RunsOfEntrant>& by_entrant) {
  double end_s = 0.0;
  for (const RunsOfEntrant& runs : by_entrant) {
    for (const auto& [condition, run] : runs) {
      if (!run->coverage.empty()) end_s = std::max(end_s, run->coverage.back().first);
    }
  }
  return end_s;
}

}  // namespace

double share_at(std::span<const std::pair<double, double>> coverage, double t_s) {
  const auto after =
      std::upper_bound(coverage.begin(), coverage.end(), t_s,
                       [](double t, const std::pair<double, double>& point) { return t < point.first; });
  return after == coverage.begin() ? 0.0 : std::prev(after)->second;
}

std::vector<MeanCoverage> mean_coverage(std::span<const TableRun> runs, std::span<const Entrant> entrants,
                                        const std::string& world) {
  std::vector<RunsOfEntrant> by_entrant(entrants.size());
  for (const TableRun& run : runs) {
    const auto entrant = std::find(entrants.begin(), entrants.end(), run.entrant);
    if (entrant != entrants.end() && (world.empty() || run.world == world))
      by_entrant[static_cast<std::size_t>(entrant - entrants.begin())][{run.world, run.seed}] = &run;
  }
  keep_common(by_entrant);
  const double end_s = end_of(by_entrant);
  std::vector<MeanCoverage> curves;
  for (std::size_t i = 0; i < entrants.size(); ++i) {
    const RunsOfEntrant& common = by_entrant[i];
    MeanCoverage curve{entrants[i], common.size(), {}};
    for (double t_s = 0.0; !common.empty() && t_s < end_s + kStep_s; t_s += kStep_s) {
      double sum = 0.0;
      for (const auto& [condition, run] : common) sum += share_at(run->coverage, t_s);
      curve.coverage.emplace_back(t_s, sum / static_cast<double>(common.size()));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

sim::Picture picture_of(std::span<const MeanCoverage> curves) {
  double end_s = 0.0;
  for (const MeanCoverage& curve : curves) {
    if (!curve.coverage.empty()) end_s = std::max(end_s, curve.coverage.back().first);
  }
  CoveragePlot plot(end_s);
  const auto colour_of = [](std::size_t i) { return kColours[i % kColours.size()]; };
  // The first above the others.
  for (std::size_t i = curves.size(); i-- > 0;) plot.curve(curves[i].coverage, colour_of(i));
  for (std::size_t i = 0; i < curves.size(); ++i) plot.legend(name_of(curves[i].entrant), colour_of(i));
  return plot.picture();
}

}  // namespace topo::bench

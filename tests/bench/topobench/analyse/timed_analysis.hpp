// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/analysis/analysis.hpp"

namespace topo::bench {

/// The stages of REPORTS "topobench analyse", in the order in which they run.
inline constexpr std::array<std::string_view, 9> kStageNames = {
    "distance", "compass", "walls", "furniture", "skeleton", "labels", "reduction", "goals", "total"};

struct TimedAnalysis {
  analysis::Analysis analysis;
  std::array<std::vector<double>, kStageNames.size()> ms;  ///< of every repetition, ascending
};

/// The whole analysis of a map, `repeat` times (at least once).
TimedAnalysis timed_analysis(const grid::DenseMap& map, int repeat,
                             const analysis::AnalysisParams& params = {});

/// Milliseconds that reading every cell of the map once takes, best of nine.
double one_pass_ms(const grid::DenseMap& map);

}  // namespace topo::bench

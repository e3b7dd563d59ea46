// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/team/coordination.hpp"
#include "core/types/stamp.hpp"

namespace topo::exploration {

enum class Strategy : std::uint8_t {
  kTopometric,       ///< the paper's: a handful of essential goals from the place map
  kNearestFrontier,  ///< Yamauchi 1997: always the nearest frontier; the baseline
  // Frontiers as well, shared out by a rule of core/team/baselines.hpp.
  kGreedyFrontier,
  kUtilityFrontier,
  kMinPos,
};

/// A row of the table of strategies: everything in which two of them differ.
struct StrategyRow {
  Strategy strategy = Strategy::kTopometric;
  std::string_view name;
  bool tours = true;  ///< essential goals, gaps and viewpoints in one tour; false: the best frontier
  team::Rule rule = team::Rule::kAlone;        ///< how a team shares goals out
  team::Rule no_k_means = team::Rule::kAlone;  ///< the same without clusters, an ablation
  /// Of the analysis while there is a goal. A frontier strategy decides nothing by places: they are for
  /// display.
  types::Duration analysis_period{};
};
const StrategyRow& row_of(Strategy strategy);

std::string_view to_text(Strategy strategy);
/// Nothing when no strategy has that name.
std::optional<Strategy> strategy_of(std::string_view text);

}  // namespace topo::exploration

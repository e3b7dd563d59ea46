// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/team/coordination.hpp"
#include "core/types/stamp.hpp"

namespace topo::exploration {

enum class Strategy : std::uint8_t {
  kTopometric,       ///< the paper's: a handful of essential goals from the place map
  kNearestFrontier,  ///< Yamauchi 1997: always the nearest frontier; the baseline
  // Frontier strategies with a rule of core/team/baselines.hpp for the team.
  kGreedyFrontier,
  kUtilityFrontier,
  kMinPos,
};

/// A row of the table of strategies: all differences between them.
struct StrategyRow {
  Strategy strategy = Strategy::kTopometric;
  std::string_view name;
  bool tours = true;  ///< essential goals, gaps and viewpoints in one tour; false: the best frontier
  team::Rule rule = team::Rule::kAlone;  ///< assignment of goals within a team
  /// Period of the analysis while there is a goal. A frontier strategy does not use places: they are for
  /// display.
  types::Duration analysis_period{};
};
const StrategyRow& row_of(Strategy strategy);

std::string_view to_text(Strategy strategy);
/// All names, in the order of the enumerators.
std::span<const std::string_view> strategy_names();
/// Nothing when no strategy has this name.
std::optional<Strategy> strategy_of(std::string_view text);

}  // namespace topo::exploration

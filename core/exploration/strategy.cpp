// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/strategy.hpp"

#include <algorithm>
#include <array>

namespace topo::exploration {
namespace {

using std::chrono::milliseconds;
using team::Rule;

// StrategyRow::analysis_period: eight periods of planning, and a longer one where places are for display
// only.
constexpr milliseconds kOften{3200}, kSeldom{5000};
constexpr std::array<StrategyRow, 5> kStrategies{{
    {Strategy::kTopometric, "topometric", true, Rule::kShares, kOften},
    {Strategy::kNearestFrontier, "nearest_frontier", false, Rule::kAlone, kSeldom},
    {Strategy::kGreedyFrontier, "greedy_frontier", false, Rule::kInTurn, kSeldom},
    {Strategy::kUtilityFrontier, "utility_frontier", false, Rule::kUtility, kSeldom},
    {Strategy::kMinPos, "min_pos", false, Rule::kMinPos, kSeldom},
}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kStrategies.size(); ++i)
    if (static_cast<std::size_t>(kStrategies[i].strategy) != i) return false;
  return true;
}
static_assert(in_order(), "row_of takes the enumerator for the row's number");

}  // namespace

const StrategyRow& row_of(Strategy strategy) { return kStrategies.at(static_cast<std::size_t>(strategy)); }

std::string_view to_text(Strategy strategy) { return row_of(strategy).name; }

std::span<const std::string_view> strategy_names() {
  static constexpr auto kNames = [] {
    std::array<std::string_view, kStrategies.size()> names;
    std::transform(kStrategies.begin(), kStrategies.end(), names.begin(),
                   [](const StrategyRow& row) { return row.name; });
    return names;
  }();
  return kNames;
}

std::optional<Strategy> strategy_of(std::string_view text) {
  const auto* const at = std::find_if(kStrategies.begin(), kStrategies.end(),
                                      [&](const StrategyRow& row) { return row.name == text; });
  if (at == kStrategies.end()) return std::nullopt;
  return at->strategy;
}

}  // namespace topo::exploration

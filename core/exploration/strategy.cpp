// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/strategy.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace topo::exploration {
namespace {

constexpr std::array<std::pair<Strategy, std::string_view>, 5> kStrategies{
    {{Strategy::kTopometric, "topometric"},
     {Strategy::kNearestFrontier, "nearest_frontier"},
     {Strategy::kGreedyFrontier, "greedy_frontier"},
     {Strategy::kUtilityFrontier, "utility_frontier"},
     {Strategy::kMinPos, "min_pos"}}};

}  // namespace

std::string_view to_text(Strategy strategy) {
  const auto* const at = std::find_if(kStrategies.begin(), kStrategies.end(),
                                      [&](const auto& entry) { return entry.first == strategy; });
  return at != kStrategies.end() ? at->second : "unknown";
}

std::optional<Strategy> strategy_of(std::string_view text) {
  const auto* const at = std::find_if(kStrategies.begin(), kStrategies.end(),
                                      [&](const auto& entry) { return entry.second == text; });
  if (at == kStrategies.end()) return std::nullopt;
  return at->first;
}

}  // namespace topo::exploration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace topo::exploration {

enum class Strategy : std::uint8_t {
  kTopometric,       ///< the paper's: a handful of essential goals from the place map
  kNearestFrontier,  ///< Yamauchi 1997: always the nearest frontier; the baseline
  // Frontiers as well; how a team shares them out (core/team/baselines.hpp).
  kGreedyFrontier,
  kUtilityFrontier,
  kMinPos,
};
std::string_view to_text(Strategy strategy);
/// Nothing when the text is none.
std::optional<Strategy> strategy_of(std::string_view text);

}  // namespace topo::exploration

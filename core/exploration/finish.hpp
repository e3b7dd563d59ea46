// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/types/result.hpp"

namespace topo::exploration {

enum class Finish : std::uint8_t {
  kEssential,  ///< ends when no essential goal and no gap onto a room is left (TourParams::overlooked_m2)
  kWorth,      ///< as kComplete, without what gives too little area for its time (worth.hpp)
  kComplete,   ///< the remaining frontiers as well, in one tour with the essential goals, and the final sweep
};

/// When an exploration ends, as an operator writes it.
struct FinishRule {
  Finish finish = Finish::kComplete;
  double rate_m2ps = 0.0;  ///< kWorth: least area for a second of a robot's time
  friend bool operator==(const FinishRule&, const FinishRule&) = default;
};

inline constexpr double kRateMin_m2ps = 0.001, kRateMax_m2ps = 10.0;  ///< of FinishRule, what can be written

/// The form of parse_finish, for messages.
inline constexpr std::string_view kFinishForm =
    "\"essential\", \"complete\", or \"worth:RATE\" with 0.001 to 10 m2 a second";

/// "essential", "complete" or "worth:RATE"; an error names what was found and what is right.
types::Result<FinishRule> parse_finish(std::string_view text);

std::string to_text(const FinishRule& rule);

}  // namespace topo::exploration

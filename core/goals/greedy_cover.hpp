// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/goals/essential_goals.hpp"
#include "core/goals/standing_places.hpp"

namespace topo::goals {

/// A place that was chosen.
struct Chosen {
  std::uint32_t place = 0;
  std::uint32_t prospect = 0;  ///< the likeliest that nobody served before
};

struct GreedyCover {
  std::vector<Chosen> chosen;  ///< in the order of choice
  std::vector<bool> served;    ///< by prospect
};

/// Few places that serve all openings worth it: greedily the one at which most can be hoped for, by the sum
/// of the chances of the openings that none serves yet, as long as that is at least `worth_min`; of several
/// the one nearest to them. A place that no opening calls its own is left out where a robot was within
/// visited_radius_m of it (paper section II-E): who was there saw what can be seen from there. Costs the
/// places, and the poses, for each that is chosen or left out. Precondition: worth_min is positive.
GreedyCover cover_openings(std::span<const Prospect> prospects, std::span<const StandingPlace> places,
                           std::span<const std::vector<types::Vector2>> visited, const GoalParams& params);

}  // namespace topo::goals

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/goals/essential_goals.hpp"
#include "core/goals/standing_places.hpp"

namespace topo::goals {

/// A selected viewpoint.
struct Chosen {
  std::uint32_t place = 0;
  std::uint32_t prospect = 0;  ///< the likeliest one that no earlier choice serves
};

struct GreedyCover {
  std::vector<Chosen> chosen;  ///< in the order of choice
  std::vector<bool> served;    ///< by prospect
};

/// A small set of viewpoints that serves all openings with enough expected information gain. Greedy: selects
/// the viewpoint with the greatest sum of the chances of its openings that are not yet served, as long as the
/// sum is at least `worth_min`; of equals the one nearest to them. A shared viewpoint (not an opening's own)
/// is skipped when a robot was within visited_radius_m (paper section II-E): all that is visible from there
/// has been seen. Cost: the viewpoints and the poses, for each one selected or skipped. Precondition:
/// worth_min is positive.
GreedyCover cover_openings(std::span<const Prospect> prospects, std::span<const StandingPlace> places,
                           std::span<const std::vector<types::Vector2>> visited, const GoalParams& params);

}  // namespace topo::goals

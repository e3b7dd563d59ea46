// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/exploration/deferred_goals.hpp"
#include "core/goals/frontiers.hpp"
#include "core/goals/goal.hpp"
#include "core/grid/wavefront.hpp"

namespace topo::exploration {

/// What proposes goals.
enum class Source : std::uint8_t {
  kEssential,  ///< the analysis: where the building goes on
  kGap,        ///< a frontier beside the essential goals
  kFrontier,   ///< a frontier strategy
  kViewpoint,  ///< the final sweep
  kPlace,      ///< an order, a home, a place of last contact
};

/// Which goal it is: kept from period to period while it is the same opening.
struct GoalId {
  Source source = Source::kPlace;
  std::uint64_t number = 0;  ///< within the source; 0: not numbered yet
  friend bool operator==(const GoalId&, const GoalId&) = default;
};

struct ProposedGoal {
  goals::Goal goal;
  GoalId id;
};
/// Goals of one source, not numbered.
std::vector<ProposedGoal> proposed_by(Source source, std::span<const goals::Goal> goals);

/// A goal, the cell from which it is seen to, and what going there costs: the route, and turning into it.
struct Candidate {
  goals::Goal goal;
  GoalId id;
  grid::CellIndex cell;
  double cost_m = 0.0;
};

/// What going to a cell costs: the way, and turning into it from where the robot looks. A search of the field
/// that was paused has to have settled the cell.
double way_cost_m(const grid::DenseMap& map, const grid::TravelField& field, grid::CellIndex cell,
                  const types::Se2& T_map_base);

/// What a robot can get to: by the map, and by what stands there now.
struct Reach {
  const grid::DenseMap& map;
  std::span<const float> clearance_m;  ///< by the map alone, as long as its cells
  const grid::TravelField& field;      ///< by both
  double radius_m = 0.0;
};

/// Goals that can be reached and are not put off, in the order given; with those that only what is unknown
/// keeps the robot from, to be looked at from where the way ends (grid/end_of_way.hpp). `cut_off` becomes
/// true when one is left out because no way leads there now.
std::vector<Candidate> candidates_of(std::span<const ProposedGoal> goals, const Reach& reach,
                                     const DeferredGoals& deferred, const types::Se2& T_map_base,
                                     types::Stamp now, bool& cut_off);

/// Those frontiers that a robot can get to, and with at least so much unknown space behind them, as goals:
/// gaps beside the essential ones, and all there are for the baselines.
std::vector<goals::Goal> frontier_goals(const grid::DenseMap& map, const grid::TravelField& field,
                                        std::span<const goals::Frontier> frontiers,
                                        double behind_min_m2 = 0.0);

/// The candidate that a present goal has become: goals recede as the map grows (paper section III).
const Candidate* successor_of(const goals::Goal& goal, std::span<const Candidate> candidates);

/// What a candidate costs all in all: the present goal's successor counts `switch_gain` of its cost.
double weighed_cost_m(const Candidate& candidate, const Candidate* present, double switch_gain);

/// The cheapest candidate; the present goal's successor stays unless another costs less than `switch_gain` of
/// it. Null when there is none.
const Candidate* choose(std::span<const Candidate> candidates, const Candidate* present, double switch_gain);

}  // namespace topo::exploration

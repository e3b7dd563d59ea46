// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/exploration/deferred_goals.hpp"
#include "core/exploration/params.hpp"
#include "core/goals/frontiers.hpp"
#include "core/goals/goal.hpp"
#include "core/grid/wavefront.hpp"

namespace topo::exploration {

/// The origin of a goal.
enum class Source : std::uint8_t {
  kEssential,  ///< the analysis: where the building continues
  kGap,        ///< a frontier beside the essential goals
  kFrontier,   ///< a frontier strategy
  kViewpoint,  ///< the final sweep
  kDoubt,      ///< a place where the map is doubted
  kPlace,      ///< an order, a home, or a place of last contact
};

/// Identity of a goal, kept from period to period while its opening is the same.
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

/// A goal, the cell from which the robot attends to it, and the cost of that: the route, and the turn into
/// it.
struct Candidate {
  goals::Goal goal;
  GoalId id;
  grid::CellIndex cell;
  double cost_m = 0.0;
};

/// Cost of going to a cell: the route, and the turn into it from the robot's heading. A paused search must
/// have settled the cell.
double way_cost_m(const grid::DenseMap& map, const grid::TravelField& field, grid::CellIndex cell,
                  const types::Se2& T_map_base, const CandidateParams& params);

/// What a robot can reach, by the map and by the present obstacles.
struct Reach {
  const grid::DenseMap& map;
  std::span<const float> clearance_m;  ///< from the map alone; as map.cells
  const grid::TravelField& field;      ///< from map and obstacles
  double radius_m = 0.0;
};

/// Goals that are reachable and not deferred, in the given order. Includes goals that only unknown space cuts
/// off; the candidate's cell is then the end of the known route (grid/end_of_way.hpp). Sets `cut_off` when a
/// goal is left out because no route leads there now.
std::vector<Candidate> candidates_of(std::span<const ProposedGoal> goals, const Reach& reach,
                                     const DeferredGoals& deferred, const types::Se2& T_map_base,
                                     types::Stamp now, const CandidateParams& params, bool& cut_off);

/// A frontier that a robot can reach, with at least this much unknown space behind it, as a goal: of the gaps
/// beside essential goals, and of the baselines. Empty for another.
std::optional<goals::Goal> frontier_goal(const grid::DenseMap& map, const grid::TravelField& field,
                                         const goals::Frontier& frontier, const CandidateParams& params,
                                         double behind_min_m2 = 0.0);

/// The candidate that succeeds a present goal: goals recede as the map grows (paper section III).
/// `successor_m`: CandidateParams.
const Candidate* successor_of(const goals::Goal& goal, std::span<const Candidate> candidates,
                              double successor_m);

/// Weighed cost of a candidate: for the successor of the present goal, `switch_gain` times its cost.
double weighed_cost_m(const Candidate& candidate, const Candidate* present, double switch_gain);

/// The cheapest candidate; the successor of the present goal, unless another costs less than `switch_gain`
/// times its cost. Null when there is none.
const Candidate* choose(std::span<const Candidate> candidates, const Candidate* present, double switch_gain);

}  // namespace topo::exploration

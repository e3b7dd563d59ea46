// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/exploration/goal_choice.hpp"
#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"
#include "core/goals/frontiers.hpp"

// Sources of candidates, each in its own file. They change only the searches of the map.
namespace topo::exploration {

/// Goals that can be reached and are not deferred.
struct Reachable {
  std::vector<Candidate> candidates;
  bool cut_off = false;  ///< a goal was left out because no route leads there now
};

/// The goals, from any source, that are reachable, not deferred, and not visited by a team-mate that is not
/// missing.
Reachable reachable(std::span<const ProposedGoal> goals, const Situation& situation,
                    const travel::RouteMap& map, const DeferredGoals& deferred,
                    const ExplorationParams& params);

/// Essential goals of the analysis (essential_source.cpp). `cut_off` is also set when a goal that the
/// analysis considers unlikely has no route now: it justifies a short wait. Not when `homing`.
Reachable essential_candidates(const Situation& situation, const travel::RouteMap& map,
                               const DeferredGoals& deferred, const ExplorationParams& params, bool homing);

/// The chance that a frontier of a map leads on, by the walls of the analysis (gap_source.cpp).
double chance_of(const goals::Frontier& frontier, const grid::DenseMap& map, const Situation& situation);

/// Gaps: frontiers that no candidate in `beside` covers (gap_source.cpp).
Reachable gap_candidates(std::span<const goals::Frontier> frontiers, std::span<const Candidate> beside,
                         const Situation& situation, const travel::RouteMap& map,
                         const DeferredGoals& deferred, const ExplorationParams& params);

/// Frontiers with more than a room of unknown space behind them, which Finish::kEssential inspects before the
/// return.
std::vector<goals::Frontier> overlooked(std::vector<goals::Frontier> frontiers, const travel::RouteMap& map,
                                        const goals::GoalParams& essential, const TourParams& params);

/// Where to look when the rest is cut off (unseen_source.cpp): for each essential goal, and each frontier of
/// `onto_much`, that has no route, the place at which the known route to it ends and unknown cells begin,
/// CandidateParams::unknown_way_m of them at most. Such places are visited once each.
std::vector<Candidate> unseen_way_candidates(std::span<const goals::Frontier> onto_much,
                                             const Situation& situation, const travel::RouteMap& map,
                                             const DeferredGoals& deferred, const ExplorationParams& params);

/// All frontiers, as the goals of a frontier strategy (gap_source.cpp).
Reachable frontier_candidates(std::span<const goals::Frontier> frontiers, const Situation& situation,
                              travel::RouteMap& map, const DeferredGoals& deferred,
                              const ExplorationParams& params);

/// The final sweep after this period (sweep_source.cpp): begins or continues when `others` is empty, and does
/// not search otherwise. `cut_off`: goals without a route are left.
SweepState swept(SweepState state, std::span<const Candidate> others, bool cut_off,
                 const Situation& situation, const travel::RouteMap& map, const ExplorationParams& params);
/// The open viewpoints of a sweep.
Reachable viewpoint_candidates(const FinalSweep& sweep, const Situation& situation,
                               const travel::RouteMap& map, const CandidateParams& params);

/// Where to look again before the end (doubt_source.cpp), but for the places where the robot has looked
/// again: where the map is doubted, so that what was mapped there is seen again, and may be matched; where
/// the map closes the way by which the robot came; and where something that stands free, and so may be gone,
/// closes a way to a frontier that may lead on. A place that is pursued stays. One without a route now is no
/// reason to wait. Cost: that of the frontiers and, where one is seen from nowhere near, of a
/// travel field.
std::vector<Candidate> doubted_candidates(const Situation& situation, const travel::RouteMap& map,
                                          const Pursuit& pursuit,
                                          std::span<const types::Vector2> looked_again,
                                          const ExplorationParams& params);

/// True when a final sweep follows an exploration.
bool has_final_sweep(const ExplorationParams& params);

/// All alternatives of a decision.
struct Proposal {
  std::vector<Candidate> candidates;
  bool cut_off = false;
  bool only_gaps = false;
  int clusters = 0;  ///< frontiers
  SweepState sweep;
};
/// Collects the candidates from the sources of the strategy (proposal.cpp). `homing`: the robot is on its way
/// home.
Proposal propose(const Situation& situation, Searches searches, const ExplorationParams& params, bool homing,
                 const DeferredGoals& deferred, SweepState sweep);

/// The alternatives when nothing else is left, or worth its time: where to look again (proposal.cpp).
std::vector<Candidate> propose_looks(const Situation& situation, Searches searches,
                                     const ExplorationParams& params, const Pursuit& pursuit,
                                     const SweepState& sweep);

}  // namespace topo::exploration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/pipeline/planning_step.hpp"
#include "core/types/result.hpp"

namespace topo::bench {

/// What a simulated exploration can decide by: the daemon's strategies, and the ablations, which are
/// `topometric` without one of its parts:
/// - topometric_no_walls: without the wall store; walls are found in what is occupied.
/// - topometric_kmeans: a team shares out the paper's clusters of goals (II-F), not by travel. Alone it is
///   `topometric`.
/// - topometric_no_kmeans: the same with single goals in place of clusters.
/// - topometric_gaps_in_turn: a gap beside the way is filled when the tour comes to it.
/// - topometric_all_looks: the final sweep looks into every corner, whatever that gives for its time.
/// - topometric_stays_out: a robot without goals waits where it is until its mates have none either.
/// - topometric_no_places: the free space is not divided: all of it is one place, whatever walls and doors
/// are
///   in it. Every opening that a robot fits through is a goal, wherever it is: there is no middle of a place
///   that it could be too near to, and no place to finish before the next. Steering, the check for unknown
///   space, the pose history and the filter of goals in sight of each other stay.
std::vector<std::string> contender_names();

/// Sets strategy and parts of the method by a name. An error lists the names.
types::Status set_contender(std::string_view name, pipeline::PlannerParams& planner);

}  // namespace topo::bench

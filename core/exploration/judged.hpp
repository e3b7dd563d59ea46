// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"
#include "core/exploration/travel_table.hpp"

namespace topo::exploration {

/// The candidates of a decision and their ways, without what is not worth its time.
struct Judged {
  std::vector<Candidate> candidates;
  TravelTable table;  ///< empty for a strategy without tours that leaves nothing out
  std::vector<LeftOutGoal> left_out;
};

/// Leaves out what Finish::kWorth does (worth.hpp), of the candidates in the table; those beyond are judged
/// when they are among the nearest. `present`: the candidate that succeeds the present goal, or null.
Judged judged(std::vector<Candidate> candidates, const Candidate* present, const Situation& situation,
              Searches searches, const ExplorationParams& params);

}  // namespace topo::exploration

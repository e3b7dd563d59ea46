// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"

namespace topo::exploration {

/// The candidate that the robot chooses, and its bids for all of them.
struct Choice {
  const Candidate* best = nullptr;  ///< null: there is none, or team-mates have them
  std::vector<team::Bid> bids;
};

/// Assigns goals within the team, then chooses by tour or by cost. `present`: the candidate that succeeds the
/// present goal, or null; `claimed_m`: the weighed cost of the present goal when it was taken.
Choice choose(std::span<const Candidate> candidates, const Candidate* present, double claimed_m,
              const Situation& situation, Searches searches, const ExplorationParams& params);

/// The first goal of the cheapest tour of the candidates; `present`, when a tour that begins with it costs
/// little more. Null for no candidates.
const Candidate* first_of_tour(std::vector<const Candidate*> candidates, const Candidate* present,
                               Searches searches, const TourParams& params);

}  // namespace topo::exploration

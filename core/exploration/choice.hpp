// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"

namespace topo::exploration {

/// Which of the candidates the robot goes for, and what it bids for all of them.
struct Choice {
  const Candidate* best = nullptr;  ///< null: none, or team-mates have them
  std::vector<team::Bid> bids;
};

/// By what the team knows: goals are shared out, then the tour or the cost decides. `present`: the candidate
/// that the present goal has become, or null; `claimed_m`: what the route to it counted when it was taken.
Choice choose(std::span<const Candidate> candidates, const Candidate* present, double claimed_m,
              const Situation& situation, Searches searches, const ExplorationParams& params);

/// Where the cheapest tour of some candidates begins, unless one that begins with `present` costs hardly
/// more. Null for no candidates.
const Candidate* first_of_tour(std::vector<const Candidate*> candidates, const Candidate* present,
                               Searches searches, const TourParams& params);

}  // namespace topo::exploration

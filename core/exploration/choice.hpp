// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"
#include "core/exploration/travel_table.hpp"

namespace topo::exploration {

/// The candidate that the robot chooses, and its bids for all of them.
struct Choice {
  const Candidate* best = nullptr;  ///< null: there is none, or team-mates have them
  std::vector<team::Bid> bids;
};

/// What there is to choose among. Borrowed for the call.
struct Alternatives {
  std::span<const Candidate> candidates;
  const TravelTable& table;            ///< of the candidates
  const Candidate* present = nullptr;  ///< the one that succeeds the present goal
  double claimed_m = 0.0;              ///< weighed cost of the present goal when it was taken
};

/// Assigns goals within the team, then chooses by tour or by cost.
Choice choose(const Alternatives& among, const Situation& situation, const travel::RouteMap& map,
              const ExplorationParams& params);

/// The first goal of the cheapest tour of a `share` of the candidates, by their indices; the present one,
/// when a tour that begins with it costs little more. Of a share that is wholly beyond the table the nearest.
/// Precondition: the share is not empty.
std::size_t first_of_tour(std::span<const std::size_t> share, const Alternatives& among,
                          const TourParams& params);

}  // namespace topo::exploration

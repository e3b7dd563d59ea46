// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "core/team/status_message.hpp"

namespace topo::team {

/// How goals are assigned to robots.
enum class Rule : std::uint8_t {
  kAlone,       ///< no coordination: the nearest goal
  kClusters,    ///< the paper's rule, with claims
  kNoClusters,  ///< the same without k-means (ablation)
  kInTurn,
  kUtility,
  kMinPos,
  kShares,  ///< each goal to the robot that is, or will be, nearest to it by travel, with claims
};

/// True when two points of the map are in sight of each other.
using PointsInSight = std::function<bool(const types::Vector2&, const types::Vector2&)>;

/// Metres of travel between two goals.
using TravelBetween = std::function<double(const types::Vector2&, const types::Vector2&)>;

/// What the robot knows of the goals besides the messages. Borrowed for the call.
struct MapView {
  PointsInSight in_sight;
  TravelBetween between_m;
};

/// Selects one of several own bids of one cluster; returns an index into the message's bids.
using Chooser = std::function<std::size_t(std::span<const std::size_t> share)>;

/// Selects the own bid that the robot pursues, from its own message (robot, bids and claim count) and those
/// of the counted team-mates; empty: the robot waits. Every robot decides locally, and equal messages give
/// equal decisions: all goals that any robot bids for are assigned, whether this robot can reach them or not.
/// A robot without a bid for a goal does not get it.
/// A goal is left to a team-mate in two cases. First, the team-mate's claim beats the robot's
/// (status_message.hpp); a claim keeps the cost at which it was made, so that both sides compare the same
/// numbers even when messages are late. Second, the team-mate, continuing from its own goal, would arrive no
/// later than this robot (paper figure 8: one robot drives along the corridor, the other waits).
/// The order of bids and of team-mates does not matter. Cost: robots times goals times bids.
std::optional<std::size_t> coordinate(Rule rule, const StatusMessage& self,
                                      std::span<const StatusMessage* const> mates, const MapView& map,
                                      const Chooser& choose = {});

}  // namespace topo::team

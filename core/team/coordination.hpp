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

/// How goals are shared out.
enum class Rule : std::uint8_t {
  kAlone,       ///< every robot for itself: the nearest
  kClusters,    ///< the paper's, with claims
  kNoClusters,  ///< the same without k-means, the ablation
  kInTurn,
  kUtility,
  kMinPos,
};

/// Are two points of the map in sight of each other?
using PointsInSight = std::function<bool(const types::Vector2&, const types::Vector2&)>;

/// Which of several of its own bids, of one cluster, a robot goes for: an index into the message's bids.
using Chooser = std::function<std::size_t(std::span<const std::size_t> share)>;

/// Which of its own bids a robot goes for, by its own message (robot, bids and claim count) and those of the
/// mates that count; nothing: it waits. Every robot decides for itself; by the same messages all decide the
/// same: what anybody bids for is shared out, whether this robot can get there or not. A robot that does not
/// bid for a goal does not want it. A goal that a mate claims, and whose claim beats the robot's
/// (status_message.hpp), is left to it; a claim keeps the cost that it was made at, so that both sides
/// compare the same numbers, however late the messages come. So is one that a mate comes past on from its own
/// goal no later than this robot would be there (paper figure 8: one goes along a corridor, the other waits).
/// The order of bids and of mates does not matter. Costs robots times goals times bids.
std::optional<std::size_t> coordinate(Rule rule, const StatusMessage& self,
                                      std::span<const StatusMessage* const> mates,
                                      const PointsInSight& in_sight, const Chooser& choose = {});

}  // namespace topo::team

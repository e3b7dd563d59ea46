// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "core/slam/alignment.hpp"
#include "core/slam/map_graph.hpp"

namespace topo::slam {

/// Requests to find the newest stretch of the own path in all that was mapped before it, as a team-mate's map
/// is found. The search for closures covers only places near the estimate (LoopParams::search_max_m). A robot
/// that went on by odometry for a while, or by a match that odometry contradicts, may be further off: it
/// comes back to known ground without a closure, and its map stays bent. The way since then, by the
/// uncertainty of the edges that no closure spans, says when to search so, and how far from the estimate a
/// place is believed: buildings have corridors that look alike.
class OwnPast {
 public:
  explicit OwnPast(const OwnPastParams& params) : params_(params) {}

  /// At most one request for every OwnPastParams::every keyframes of the own path.
  std::optional<AlignmentQuery> take(const MapGraph& graph, const MapperParams& params);

  /// A request of a robot that has nothing else to do: its newest stretch, however short the way since the
  /// last request, then the stretches before it, back to its start; empty when there is none left. A stretch
  /// whose search failed may be found once corrections have moved what it is searched in.
  std::optional<AlignmentQuery> take_idle(const MapGraph& graph, const MapperParams& params);

 private:
  OwnPastParams params_;
  std::size_t asked_at_ = 0;        ///< keyframes of the own path at the last decision
  std::size_t looked_back_to_ = 0;  ///< end of the stretch that idleness came to
};

}  // namespace topo::slam

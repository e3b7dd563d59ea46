// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/grid/wavefront.hpp"
#include "core/team/status_message.hpp"

// Two robots that meet where only one can pass: which of them makes room is decided by their messages alone,
// so that both come to the same end.
namespace topo::team {

struct RightOfWayParams {
  double near_m = 3.0;  ///< mates further away are no matter yet
  double room_m = 0.9;  ///< between the centres of two robots that pass each other: two discs and a little
  /// Two swing radii (0.53 m), both slowing down from 0.65 m/s (0.72), and closing at twice that for a
  /// planning period and the scanner's and the base's delay (0.65).
  double beside_m = 2.0;
  double abreast_m = 0.3;  ///< ahead or behind by less is neither
  double speed_mps = 0.7;  ///< of a mate since it was last heard of
};

/// Has a robot to go slowly for a mate that moves, and was heard of `age_s` ago? Two robots see each other
/// where they were: what is free of one when it is looked at is not when it gets there. Who has the mate
/// clearly behind it drives on, so that two with one way do not crawl side by side; of two abreast the one
/// with the lower id.
bool slows_for(const StatusMessage& self, const StatusMessage& mate, double age_s,
               const RightOfWayParams& params = {});

/// The mate that this robot has to make room for: near, with a way that leads through where this robot is;
/// and either this one stands, or their ways lead through each other and the mate's id is lower. Null when
/// there is none. Of several the lowest id.
const StatusMessage* who_needs_room(const StatusMessage& self, std::span<const StatusMessage* const> mates,
                                    const RightOfWayParams& params = {});

/// Where to make room: the cheapest cell to get to that is room_m off the mate's way and off every mate, at
/// most `search_m` away; nothing when there is none. Looks at every fourth cell each way.
std::optional<grid::CellIndex> room_beside(const grid::DenseMap& map, const grid::TravelField& field,
                                           const StatusMessage& mate,
                                           std::span<const StatusMessage* const> mates, double search_m,
                                           const RightOfWayParams& params = {});

}  // namespace topo::team

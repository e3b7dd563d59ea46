// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/grid/wavefront.hpp"
#include "core/team/right_of_way_params.hpp"
#include "core/team/status_message.hpp"

// Two robots that meet where only one can pass: which of them gives way is decided from their messages alone,
// so that both come to the same decision.
namespace topo::team {

/// True when the robot must drive slowly because of a moving team-mate whose message is `age_s` old. Two
/// robots see each other where they were: space that is free when it is checked may be occupied on arrival.
/// The robot that has the team-mate clearly behind it drives on, so that two robots with the same route do
/// not both slow down side by side; of two abreast the one with the lower id drives on, unless they may
/// already be in contact.
bool slows_for(const StatusMessage& self, const StatusMessage& mate, double age_s,
               const RightOfWayParams& params = {});

/// The team-mate to which this robot must give way: it is near, its route leads through this robot's
/// position, and either this robot stands, or each route leads through the other's position and the
/// team-mate's id is lower. Null when there is none; of several the lowest id.
const StatusMessage* who_needs_room(const StatusMessage& self, std::span<const StatusMessage* const> mates,
                                    const RightOfWayParams& params = {});

/// The cell to which the robot gives way: the cheapest one that is room_m from the team-mate's route and from
/// every team-mate, at most `search_m` away along each axis; empty when there is none. Checks every
/// stride_cells-th cell along each axis.
std::optional<grid::CellIndex> room_beside(const grid::DenseMap& map, const grid::TravelField& field,
                                           const StatusMessage& mate,
                                           std::span<const StatusMessage* const> mates, double search_m,
                                           const RightOfWayParams& params = {});

}  // namespace topo::team

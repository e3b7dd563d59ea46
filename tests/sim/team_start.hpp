// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/types/result.hpp"
#include "tests/sim/world.hpp"

namespace topo::sim {

/// Can a robot stand here and set out whichever way it faces? Nobody puts a robot down so near to a wall that
/// it could not.
bool has_room(const World& world, const Se2& pose);

/// Where the robots of a team stand when they enter at one spot: the first at the spot, the others as near
/// to it as the world allows, one beside the other, with a straight way to the spot and all facing as it
/// does. An error names how many found room.
types::Result<std::vector<Se2>> team_starts(const World& world, const Se2& spot, int robots);

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

// A team-mate seen by a laser is neither wall nor map: beams that end at one are taken out of a scan before
// the mapper gets it. What drives and what stops the robot sees them as they are.
namespace topo::team {

/// Beams of a level scanner that end within `radius_m` of a team-mate become kInvalid: they tell nothing of
/// the building. Mates in the frame of `T_map_laser`. Returns how many.
std::size_t mask_mates(types::Scan& scan, const types::Se2& T_map_laser,
                       std::span<const types::Vector2> mates, double radius_m);

/// The same of the coronal scanner, whose beams go left and up: angle 0 is up, and positive is left. What is
/// half a metre above the scanner is no mate.
std::size_t mask_mates_coronal(types::Scan& scan, const types::Se2& T_map_laser,
                               std::span<const types::Vector2> mates, double radius_m);

}  // namespace topo::team

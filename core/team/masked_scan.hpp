// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

// A team-mate seen by a laser is not part of the building: beams that end at one are removed from a scan
// before the mapper gets it. The modules that drive and stop the robot get the scan unmasked.
namespace topo::team {

/// Beams of a level scanner that end within `radius_m` of a team-mate become kInvalid: they carry no
/// information about the building. `mates` are in the target frame of `T_map_laser`. Returns the number of
/// masked beams.
std::size_t mask_mates(types::Scan& scan, const types::Se2& T_map_laser,
                       std::span<const types::Vector2> mates, double radius_m);

/// The same for the coronal scanner, whose beams go left and up: angle 0 is up, positive is left. A beam that
/// ends more than half a metre above the scanner does not hit a team-mate.
std::size_t mask_mates_coronal(types::Scan& scan, const types::Se2& T_map_laser,
                               std::span<const types::Vector2> mates, double radius_m);

}  // namespace topo::team

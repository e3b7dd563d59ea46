// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <string>

namespace topo::daemon {

/// Field of view of the front scanner for which a mount is checked: that of a UTM-30LX, 1081 beams from -135
/// to 135 degrees (PROTOCOLS section 11). What a connected sensor really sees of the forward sector is judged
/// by the gate, scan by scan (perception::forward_valid_fraction).
inline constexpr double kFieldOfView_rad = 1.5 * std::numbers::pi;

/// Angle of the forward sector (perception::StopZoneParams::forward_sector_rad to either side of straight
/// ahead) that a scanner sees whose zero beam is turned by `yaw_rad` and whose view is `field_of_view_rad`
/// wide, in radians. Precondition: both are finite, the view is at most one turn.
[[nodiscard]] double seen_of_forward_sector_rad(double yaw_rad, double field_of_view_rad = kFieldOfView_rad);

/// Greatest yaw of a front scanner, either way, with which it sees the whole forward sector.
[[nodiscard]] double yaw_max_rad();

/// Empty when a front scanner mounted at `yaw_rad` sees the whole forward sector; otherwise the fault: the
/// angles found and needed, and the mounts that would be right.
[[nodiscard]] std::string forward_view_fault(double yaw_rad);

}  // namespace topo::daemon

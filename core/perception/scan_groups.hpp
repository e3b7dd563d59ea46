// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/perception/params.hpp"
#include "core/perception/scan_look.hpp"

namespace topo::perception {

/// Small object that stands free of its background: a person's legs, a robot, a chair.
struct ScanGroup {
  types::Vector2 centre{0.0, 0.0};                ///< mean of its hits, in the sweep's frame
  types::Vector2 begin{0.0, 0.0}, end{0.0, 0.0};  ///< mean of the hits near the first, near the last
  bool begins_freely = false, ends_freely = false;
  double radius_m = 0.0;            ///< of the circle about the centre that holds its hits
  double farthest_m = 0.0;          ///< hits beyond this are background
  std::size_t first = 0, last = 0;  ///< beams; background between the legs is among them
};

/// Finds groups by range jumps; legs near each other are one group. An end is not free when a
/// nearer object hides it, when it continues in another surface or when the scan cuts it off: as the robot
/// drives, the edge of a shadow moves over static surfaces. Groups without a free end are left out. Returns
/// how many were written.
std::size_t find_groups(const ScanLook& look, const ScanGroupParams& params, std::span<ScanGroup> out);

/// Calls visit(point) for a group's hits.
template <class Visit>
void for_each_point(const ScanLook& look, const ScanGroup& group, Visit visit) {
  for (std::size_t i = group.first; i <= group.last; ++i)
    if (look.is_hit(i) && static_cast<double>(look.range_m[i]) <= group.farthest_m) visit(look.points[i]);
}

}  // namespace topo::perception

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/perception/scan_look.hpp"

namespace topo::perception {

/// Something small that stands free of what is behind it: a person's legs, a robot, a chair.
struct ScanGroup {
  types::Vector2 centre{0.0, 0.0};                ///< mean of its hits, in the look's frame
  types::Vector2 begin{0.0, 0.0}, end{0.0, 0.0};  ///< mean of the hits within 8 cm of the first, of the last
  bool begins_freely = false, ends_freely = false;
  double radius_m = 0.0;            ///< of the circle about the centre that holds its hits
  double farthest_m = 0.0;          ///< of its hits
  std::size_t first = 0, last = 0;  ///< beams; what is between legs is farther off
};

inline constexpr double kGroupAcross_m = 0.9;  ///< the largest

/// Groups within 6 m, by jumps of distance; legs up to 0.4 m apart are one. An end that something nearer
/// hides, that goes on in something else or that the scan cuts off is not free: as the robot drives, the edge
/// of a shadow moves over what stands. Groups without a free end are left out. Returns how many were written.
std::size_t find_groups(const ScanLook& look, std::span<ScanGroup> out);

/// Calls visit(point) for a group's hits.
template <class Visit>
void for_each_point(const ScanLook& look, const ScanGroup& group, Visit visit) {
  for (std::size_t i = group.first; i <= group.last; ++i)
    if (look.is_hit(i) && static_cast<double>(look.range_m[i]) <= group.farthest_m) visit(look.points[i]);
}

}  // namespace topo::perception

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/masked_scan.hpp"

#include <algorithm>
#include <cmath>

namespace topo::team {
namespace {

using types::Vector2;

constexpr double kMast_m = 0.5;  // no part of a team-mate is that far above another robot's mast scanner

/// `ends(range, angle)`: the end of a beam in the scanner's frame, projected onto the floor.
template <class Ends>
std::size_t mask(types::Scan& scan, const types::Se2& T_map_laser, std::span<const Vector2> mates,
                 double radius_m, Ends ends) {
  std::size_t masked = 0;
  for (std::size_t i = 0; i < scan.checked_beams() && !mates.empty(); ++i) {
    if (!types::is_hit(scan.range_m[i])) continue;
    const Vector2 end =
        T_map_laser * ends(static_cast<double>(scan.range_m[i]), static_cast<double>(scan.angle_rad(i)));
    const bool at_mate = std::any_of(mates.begin(), mates.end(), [&](const Vector2& mate) {
      return (mate - end).squaredNorm() <= radius_m * radius_m;
    });
    if (!at_mate) continue;
    scan.range_m[i] = types::kInvalid;
    ++masked;
  }
  return masked;
}

}  // namespace

std::size_t mask_mates(types::Scan& scan, const types::Se2& T_map_laser, std::span<const Vector2> mates,
                       double radius_m) {
  return mask(scan, T_map_laser, mates, radius_m, [](double range_m, double angle_rad) {
    return Vector2(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
  });
}

std::size_t mask_mates_coronal(types::Scan& scan, const types::Se2& T_map_laser,
                               std::span<const Vector2> mates, double radius_m) {
  return mask(scan, T_map_laser, mates, radius_m, [](double range_m, double angle_rad) {
    if (range_m * std::cos(angle_rad) > kMast_m) return Vector2(HUGE_VAL, 0.0);  // above a team-mate
    return Vector2(0.0, range_m * std::sin(angle_rad));
  });
}

}  // namespace topo::team

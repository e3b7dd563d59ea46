// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/forward_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/perception/params.hpp"
#include "core/types/se2.hpp"

namespace topo::daemon {
namespace {

constexpr double kSector_rad = perception::StopZoneParams{}.forward_sector_rad;
constexpr double kNeeded_rad = 2.0 * kSector_rad;
constexpr double kRounding_rad = 1e-6;

double degrees(double angle_rad) { return angle_rad / types::kDegree_rad; }

}  // namespace

double seen_of_forward_sector_rad(double yaw_rad, double field_of_view_rad) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  const double centre_rad = types::wrap_angle(yaw_rad);
  const double half_rad = 0.5 * std::min(field_of_view_rad, kTurn_rad);
  double seen_rad = 0.0;
  // A view turned backwards reaches the sector from both sides, over the turn's end.
  for (const double turn_rad : {-kTurn_rad, 0.0, kTurn_rad}) {
    const double from_rad = std::max(centre_rad + turn_rad - half_rad, -kSector_rad);
    const double to_rad = std::min(centre_rad + turn_rad + half_rad, kSector_rad);
    seen_rad += std::max(to_rad - from_rad, 0.0);
  }
  return std::min(seen_rad, kNeeded_rad);
}

double yaw_max_rad() { return 0.5 * kFieldOfView_rad - kSector_rad; }

std::string forward_view_fault(double yaw_rad) {
  const double seen_rad = seen_of_forward_sector_rad(yaw_rad);
  if (seen_rad >= kNeeded_rad - kRounding_rad) return {};
  const double printed_rad =
      std::floor(yaw_max_rad() * 1e3) * 1e-3;  // rounded down: what is printed is accepted
  return fmt::format(
      "found {} ({:.0f} degrees): a scanner with {:.0f} degrees of view (UTM-30LX) then sees {:.0f} of the "
      "{:.0f} degrees ahead that braking needs ({:.0f} to either side), and the robot would drive blind; "
      "expected -{:.3f} to {:.3f} ({:.0f} degrees either way)",
      yaw_rad, degrees(yaw_rad), degrees(kFieldOfView_rad), std::floor(degrees(seen_rad + kRounding_rad)),
      degrees(kNeeded_rad), degrees(kSector_rad), printed_rad, printed_rad, degrees(yaw_max_rad()));
}

}  // namespace topo::daemon

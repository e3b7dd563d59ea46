// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/masks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/perception/params.hpp"

namespace topo::daemon {
namespace {

constexpr double kBraking_rad = perception::StopZoneParams{}.forward_sector_rad;

double in_degrees(double angle_rad) { return angle_rad / types::kDegree_rad; }

/// Of a mask within `half_rad` to either side of straight ahead.
double overlap_rad(const types::Sector& mask, double half_rad) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  double sum_rad = 0.0;
  for (const double turn_rad : {-kTurn_rad, 0.0, kTurn_rad}) {
    const double from_rad = std::max(mask.from_rad + turn_rad, -half_rad);
    const double to_rad = std::min(mask.to_rad + turn_rad, half_rad);
    sum_rad += std::max(to_rad - from_rad, 0.0);
  }
  return sum_rad;
}

}  // namespace

bool read_sectors(const toml::node& node, types::Sectors& sectors) {
  const auto* list = node.as_array();
  if (list == nullptr || list->size() > types::Sectors::kMost) return false;
  types::Sectors read;
  for (const auto& element : *list) {
    const auto* pair = element.as_array();
    if (pair == nullptr || pair->size() != 2) return false;
    std::array<double, 2> angle_deg{};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto value = (*pair)[i].value<double>();
      if (!(*pair)[i].is_number() || !value || !(std::abs(*value) <= 360.0)) return false;
      angle_deg[i] = *value;
    }
    if (!(angle_deg[0] < angle_deg[1]) || angle_deg[1] - angle_deg[0] >= 360.0) return false;
    read.all[read.count++] = {angle_deg[0] * types::kDegree_rad, angle_deg[1] * types::kDegree_rad};
  }
  sectors = read;
  return true;
}

std::string sectors_text(const types::Sectors& sectors) {
  std::string text;
  // Twelve digits: degrees that become radians and degrees again are the same text.
  for (std::size_t i = 0; i < sectors.count; ++i)
    text += fmt::format("{}[{:#.12g}, {:#.12g}]", i == 0 ? "" : ", ", in_degrees(sectors.all[i].from_rad),
                        in_degrees(sectors.all[i].to_rad));
  return "[" + text + "]";
}

std::string masks_fault(const types::Sectors& masks, const MaskBounds& bounds) {
  constexpr double kTolerance_rad = 1e-6;
  double all_rad = 0.0;
  for (std::size_t i = 0; i < masks.count; ++i) {
    const types::Sector& mask = masks.all[i];
    const double forward_rad = overlap_rad(mask, kBraking_rad);
    all_rad += forward_rad;
    const std::string found =
        fmt::format("found {:.4g} to {:.4g} degrees: ", in_degrees(mask.from_rad), in_degrees(mask.to_rad));
    if (overlap_rad(mask, bounds.ahead_rad) > kTolerance_rad)
      return found + fmt::format(
                         "within {:.0f} degrees of straight ahead nothing else sees what the robot "
                         "drives into; expected masks beside",
                         in_degrees(bounds.ahead_rad));
    if (forward_rad > bounds.one_rad + kTolerance_rad)
      return found + fmt::format(
                         "{:.4g} degrees of it are in the sector that braking needs ({:.0f} to either "
                         "side of straight ahead); expected at most {:.0f} there: mount the scanner so "
                         "that less of the robot is before it",
                         in_degrees(forward_rad), in_degrees(kBraking_rad), in_degrees(bounds.one_rad));
  }
  const double most_rad = bounds.share * 2.0 * kBraking_rad;
  if (all_rad <= most_rad + kTolerance_rad) return {};
  return fmt::format(
      "found {:.4g} degrees together in the sector that braking needs ({:.0f} to either side of "
      "straight ahead); expected at most {:.0f}",
      in_degrees(all_rad), in_degrees(kBraking_rad), in_degrees(most_rad));
}

}  // namespace topo::daemon

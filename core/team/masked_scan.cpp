// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/masked_scan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace topo::team {
namespace {

using types::Vector2;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr double kSectorMax_rad = 100.0 * kTurn_rad;
constexpr double kMast_m = 0.5;  // no part of a team-mate is that far above another robot's mast scanner

/// Masks the beam when it ends at a mate; `end`: in the scanner's frame, projected onto the floor.
bool mask_at(const Vector2& mate, double radius_m, const Vector2& end, float& range_m) {
  if ((mate - end).squaredNorm() > radius_m * radius_m) return false;
  range_m = types::kInvalid;
  return true;
}

/// Beams [first, last).
struct BeamRange {
  std::size_t first = 0, last = 0;
};

/// The beams at bearings from `low_rad` to `high_rad`, and a neighbour on either side for rounding.
BeamRange beams_between(const types::Scan& scan, double low_rad, double high_rad) {
  const auto [low, high] =
      std::minmax({scan.beam_at(low_rad), scan.beam_at(high_rad)});  // a mirrored scanner counts down
  const auto beams = static_cast<double>(scan.checked_beams());
  return {static_cast<std::size_t>(std::clamp(std::floor(low) - 1.0, 0.0, beams)),
          static_cast<std::size_t>(std::clamp(std::ceil(high) + 2.0, 0.0, beams))};
}

/// The bearings that `scan` looks at, lowest and highest. Where a sector begins is the scanner's affair, and
/// a mirrored one counts down from there: the sector may be turns away from (-pi, pi].
std::pair<double, double> sector_of(const types::Scan& scan) {
  return std::minmax({static_cast<double>(scan.angle_rad(0)),
                      static_cast<double>(scan.angle_rad(scan.checked_beams() - 1))});
}

/// Only the beams that pass the mate are looked at: the scan of a level scanner has a thousand, forty times
/// a second.
std::size_t mask_one(types::Scan& scan, const Vector2& mate, double radius_m) {
  const double distance_m = mate.norm();
  const double half_rad = distance_m > radius_m ? std::asin(radius_m / distance_m) : std::numbers::pi;
  const double bearing_rad = std::atan2(mate.y(), mate.x());
  if (scan.checked_beams() == 0) return 0;
  const auto [lowest_rad, highest_rad] = sector_of(scan);
  // No scanner's sector; its rounds would not end.
  if (!(std::max(-lowest_rad, highest_rad) < kSectorMax_rad)) return 0;
  const double turns = std::floor((lowest_rad - half_rad - bearing_rad) / kTurn_rad);
  std::size_t masked = 0;
  for (double middle_rad = bearing_rad + turns * kTurn_rad; middle_rad - half_rad <= highest_rad;
       middle_rad += kTurn_rad) {
    const BeamRange beams = beams_between(scan, middle_rad - half_rad, middle_rad + half_rad);
    for (std::size_t i = beams.first; i < beams.last; ++i) {
      if (!types::is_hit(scan.range_m[i])) continue;
      const auto range_m = static_cast<double>(scan.range_m[i]);
      const auto angle_rad = static_cast<double>(scan.angle_rad(i));
      const Vector2 end(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
      if (mask_at(mate, radius_m, end, scan.range_m[i])) ++masked;
    }
  }
  return masked;
}

/// The scanner's plane is across the robot: a mate farther ahead or behind than its radius is not in it.
std::size_t mask_one_coronal(types::Scan& scan, const Vector2& mate, double radius_m) {
  if (std::abs(mate.x()) > radius_m) return 0;
  std::size_t masked = 0;
  for (std::size_t i = 0; i < scan.checked_beams(); ++i) {
    if (!types::is_hit(scan.range_m[i])) continue;
    const auto range_m = static_cast<double>(scan.range_m[i]);
    const auto angle_rad = static_cast<double>(scan.angle_rad(i));
    if (range_m * std::cos(angle_rad) > kMast_m) continue;  // above a team-mate
    if (mask_at(mate, radius_m, {0.0, range_m * std::sin(angle_rad)}, scan.range_m[i])) ++masked;
  }
  return masked;
}

template <class MaskOne>
std::size_t mask_all(types::Scan& scan, const types::Se2& T_map_laser, std::span<const Vector2> mates,
                     double radius_m, MaskOne mask) {
  const types::Se2 T_laser_map = T_map_laser.inverse();
  std::size_t masked = 0;
  for (const Vector2& mate : mates) masked += mask(scan, T_laser_map * mate, radius_m);
  return masked;
}

}  // namespace

std::size_t mask_mates(types::Scan& scan, const types::Se2& T_map_laser, std::span<const Vector2> mates,
                       double radius_m) {
  return mask_all(scan, T_map_laser, mates, radius_m, mask_one);
}

std::size_t mask_mates_coronal(types::Scan& scan, const types::Se2& T_map_laser,
                               std::span<const Vector2> mates, double radius_m) {
  return mask_all(scan, T_map_laser, mates, radius_m, mask_one_coronal);
}

}  // namespace topo::team

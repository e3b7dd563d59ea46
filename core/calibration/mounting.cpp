// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/mounting.hpp"

#include <algorithm>
#include <cmath>

namespace topo::calibration {
namespace {

/// A person stands roughly to the left: up to half of the way to ahead or behind.
constexpr double kLeft_rad = 90.0 * types::kDegree_rad, kAbout_rad = 50.0 * types::kDegree_rad;

/// What an upright scanner sees of a person beside the robot: more than furniture that was pushed.
constexpr double kTall_m = 0.5, kAside_m = 0.4;

/// +1: to the left, -1: to the right, 0: neither.
int side_of(double turn_rad) {
  const double turn = types::wrap_angle(turn_rad);
  return std::abs(std::abs(turn) - kLeft_rad) > kAbout_rad ? 0 : turn > 0.0 ? 1 : -1;
}

/// Feet are where the floor is: where only the ceiling is seen, a head is not as near to it.
bool stands_on(const Newcomer& person, const FloorLine& floor) {
  constexpr double kFeet_m = 0.5;  // lower may be out of the scanner's view
  const types::Vector2 down(std::cos(floor.down_rad), std::sin(floor.down_rad));
  return floor.height_m - std::max(person.ends_m[0].dot(down), person.ends_m[1].dot(down)) < kFeet_m;
}

}  // namespace

MountResult<AheadSeen> level_scanner(std::span<const StillPicture> before,
                                     std::span<const StillPicture> ahead, double yaw_max_rad) {
  std::optional<AheadSeen> seen;
  for (std::size_t i = 0; i < std::min(before.size(), ahead.size()); ++i) {
    const std::vector<Newcomer> found = newcomers(before[i], ahead[i]);
    if (found.empty()) continue;
    if (found.size() > 1) return MountDoubt::kSeveral;
    if (seen) return MountDoubt::kBothAhead;
    seen = AheadSeen{i, found.front().angle_rad};
  }
  if (!seen) return MountDoubt::kNobody;
  if (std::abs(types::wrap_angle(seen->angle_rad)) > yaw_max_rad) return MountDoubt::kLooksAside;
  return *seen;
}

MountResult<LevelMount> level_mount(double ahead_rad, const StillPicture& before, const StillPicture& left) {
  const std::vector<Newcomer> found = newcomers(before, left);
  if (found.empty()) return MountDoubt::kNobody;
  if (found.size() > 1) return MountDoubt::kSeveral;
  const int side = side_of(found.front().angle_rad - ahead_rad);
  if (side == 0) return MountDoubt::kNotBeside;
  // A mirrored scanner's angles are turned round before the yaw is added.
  return LevelMount{types::wrap_angle(side > 0 ? -ahead_rad : ahead_rad), side < 0};
}

MountResult<UprightMount> upright_mount(const StillPicture& before, const StillPicture& left) {
  const std::vector<Newcomer> found = newcomers(before, left);
  if (found.empty()) return MountDoubt::kNotInPlane;
  if (found.size() > 1) return MountDoubt::kSeveral;
  const Newcomer& person = found.front();
  if (person.width_m < kTall_m) return MountDoubt::kNotInPlane;
  const auto floor = find_floor(before, person.axis_rad);
  if (!floor || !stands_on(person, *floor)) return MountDoubt::kNoFloor;
  // Angle from straight up is the scanner's angle plus the roll, mirrored or not (walls::CoronalMount).
  const double roll_rad = types::wrap_angle(180.0 * types::kDegree_rad - floor->down_rad);
  const double aside_m =
      person.middle_m.norm() * std::sin(std::atan2(person.middle_m.y(), person.middle_m.x()) + roll_rad);
  if (std::abs(aside_m) < kAside_m) return MountDoubt::kNotBeside;
  return UprightMount{roll_rad, floor->height_m, aside_m < 0.0};
}

}  // namespace topo::calibration

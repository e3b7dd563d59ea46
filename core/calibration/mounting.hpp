// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <variant>

#include "core/calibration/floor_line.hpp"
#include "core/calibration/newcomer.hpp"

namespace topo::calibration {

// How scanners are mounted, from a person who stands first ahead of the robot, then to its left.

/// Why the pictures do not tell it.
enum class MountDoubt {
  kNobody,      ///< no scanner sees a person who was not there before
  kSeveral,     ///< a scanner sees several newcomers: who is meant?
  kBothAhead,   ///< several scanners see who stands ahead: none of them looks across the way
  kLooksAside,  ///< the level scanner sees ahead farther to the side than braking allows
  kNotBeside,   ///< for the level scanner nobody moved to the side
  kNotInPlane,  ///< the upright scanner does not see who stands to the left
  kNoFloor,     ///< the upright scanner sees no floor to both sides
};

/// The scanner that sees who stands ahead, and where, in its own frame.
struct AheadSeen {
  std::size_t scanner = 0;
  double angle_rad = 0.0;
};

/// A level scanner: ScannerConfig's yaw_rad and mirrored.
struct LevelMount {
  double yaw_rad = 0.0;  ///< as exactly as somebody stands straight ahead: some ten degrees
  bool mirrored = false;
};

/// An upright scanner: ScannerConfig's roll_rad, mirrored and z_m.
struct UprightMount {
  double roll_rad = 0.0, z_m = 0.0;
  bool mirrored = false;
};

template <class T>
using MountResult = std::variant<T, MountDoubt>;

/// Which scanner is the level one: the one that sees who stands ahead, at most `yaw_max_rad` from its zero
/// beam. Both spans are by scanner.
[[nodiscard]] MountResult<AheadSeen> level_scanner(std::span<const StillPicture> before,
                                                   std::span<const StillPicture> ahead, double yaw_max_rad);

/// Its mount, from where it saw them ahead, and now to the left.
[[nodiscard]] MountResult<LevelMount> level_mount(double ahead_rad, const StillPicture& before,
                                                  const StillPicture& left);

/// Mount of the other one, from the floor and who stands to the left.
[[nodiscard]] MountResult<UprightMount> upright_mount(const StillPicture& before, const StillPicture& left);

}  // namespace topo::calibration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace topo::motion {

/// What a motion backwards rests on, which whoever asks for it vouches for: the rear is blind.
enum class Backing : std::uint8_t {
  kNone,
  /// The way the robot came. It may leave a pressed front bumper or a stall.
  kAlongTrail,
  /// Straight, over ground that the scanner looked over lately (SeenGround), so that BlindSpot has what
  /// stands beside it.
  kOverSeenGround,
};

}  // namespace topo::motion

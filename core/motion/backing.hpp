// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace topo::motion {

/// Justification of a reverse motion, for which the requester is responsible: the rear is blind.
enum class Backing : std::uint8_t {
  kNone,
  /// Along the breadcrumb path. Allowed with a pressed front bumper or a stall.
  kAlongTrail,
  /// Straight, over ground that the scanner observed recently (SeenGround), so that BlindSpot has the
  /// obstacles beside it.
  kOverSeenGround,
};

}  // namespace topo::motion

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/se2.hpp"

namespace topo::perception {

/// Disc that moves in a straight line. Its size is that of the part visible to the scanner.
struct MovingObstacle {
  types::Vector2 centre{0.0, 0.0};
  types::Vector2 velocity_mps{0.0, 0.0};
  double radius_m = 0.0;
};

}  // namespace topo::perception

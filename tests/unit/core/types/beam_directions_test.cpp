// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/beam_directions.hpp"

#include <gtest/gtest.h>

namespace topo::types {
namespace {

TEST(BeamDirections, areTheSineAndCosineOfEveryBeam) {
  ScanGeometry geometry;
  geometry.angle_min_rad = -2.3562F;
  geometry.angle_increment_rad = 0.0043633F;
  for (const std::size_t first : {std::size_t{0}, std::size_t{700}}) {
    BeamDirections direction(geometry, 0.4, first);
    for (std::size_t i = first; i < Scan::kMaxBeams; ++i, direction.advance()) {
      const double angle_rad = static_cast<double>(geometry.angle_min_rad) +
                               static_cast<double>(i) * static_cast<double>(geometry.angle_increment_rad) +
                               0.4;
      ASSERT_NEAR(direction.now().x(), std::cos(angle_rad), 1e-12) << i;
      ASSERT_NEAR(direction.now().y(), std::sin(angle_rad), 1e-12) << i;
    }
  }
}

}  // namespace
}  // namespace topo::types

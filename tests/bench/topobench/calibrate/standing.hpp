// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/calibration/still_picture.hpp"
#include "tests/sim/laser.hpp"

namespace topo::bench {

/// A robot that stands in the furnished room, with scanners mounted somehow, and somebody who stands about.
struct Standing {
  sim::LaserMount level{0.021, 0.0, 0.30, 0.0, sim::ScanPlane::kLevel, 0.0, false};
  sim::LaserMount upright{0.10, 0.0, 0.40, 0.0, sim::ScanPlane::kCoronal, 0.0, false};
  sim::Se2 pose{4.0, 3.0, 0.3};
  std::uint64_t seed = 1;

  /// `people`: where they stand, from the robot.
  [[nodiscard]] calibration::StillPicture seen(const sim::LaserMount& mount,
                                               const std::vector<sim::Vector2>& people) const;
  [[nodiscard]] std::vector<calibration::StillPicture> both(const std::vector<sim::Vector2>& people) const {
    return {seen(level, people), seen(upright, people)};
  }
};

}  // namespace topo::bench

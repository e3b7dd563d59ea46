// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::types {

/// Unit vectors along a scan's beams, in order, in a frame in which the sensor's x axis has the heading
/// `yaw_rad`. Each vector is the previous one rotated by the angle increment, which avoids a sine per beam.
/// The error after all beams of a scan is below 1e-12.
class BeamDirections {
 public:
  BeamDirections(const ScanGeometry& geometry, double yaw_rad, std::size_t first_beam = 0) {
    const double step_rad = static_cast<double>(geometry.angle_increment_rad);
    const double first_rad =
        static_cast<double>(geometry.angle_min_rad) + static_cast<double>(first_beam) * step_rad + yaw_rad;
    now_ = {std::cos(first_rad), std::sin(first_rad)};
    step_ = {std::cos(step_rad), std::sin(step_rad)};
  }
  [[nodiscard]] const Vector2& now() const { return now_; }
  void advance() {
    now_ = {now_.x() * step_.x() - now_.y() * step_.y(), now_.x() * step_.y() + now_.y() * step_.x()};
  }

 private:
  Vector2 now_, step_;
};

}  // namespace topo::types

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/calibration/fit.hpp"

namespace topo::calibration {

/// A part of the drive in which the scanner was elsewhere on the robot than in the whole.
struct Shift {
  double from_s = 0.0;                         ///< of the part, since the first interval
  double yaw_rad = 0.0, x_m = 0.0, y_m = 0.0;  ///< of the part less the whole
};

/// The greatest shift, if there is one: each part of the drive is held against the fit of the whole with only
/// the scanner's place free, and with the intervals that the fit left out, because those of a scanner that
/// was bumped are among them.
[[nodiscard]] std::optional<Shift> find_shift(const Fit& fit, std::span<const Interval> intervals,
                                              double overlap, const SteadinessParams& params,
                                              const FitParams& fit_params);

}  // namespace topo::calibration

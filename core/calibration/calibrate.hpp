// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/calibration/coronal_fit.hpp"
#include "core/calibration/verdict.hpp"

namespace topo::calibration {

/// What is assumed before the drive: by the model, the configuration, or an earlier calibration.
struct Assumed {
  RobotNumbers numbers;
  double front_z_m = 0.3;
  walls::CoronalMount coronal;
};

/// What a drive calibrated. Believable when `refusals` is empty; the numbers are there for the report all the
/// same, where there are any.
struct Calibration {
  std::optional<Fit> fit;
  std::optional<Shift> shift;
  std::optional<CoronalFit> coronal;  ///< only of a believable fit, and where there are coronal scans
  DriveEvidence evidence;
  std::vector<Refusal> refusals;
  [[nodiscard]] bool believable() const { return fit.has_value() && refusals.empty(); }
};

/// Calibrates wheels and scanners from one drive. Pure; takes about a second of processor time a minute of
/// driving.
[[nodiscard]] Calibration calibrate(const DriveLog& drive, const Assumed& assumed,
                                    const CalibrationParams& params);

}  // namespace topo::calibration

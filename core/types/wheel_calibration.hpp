// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::types {

/// How the wheels of one robot differ from the model whose factors its firmware uses.
struct WheelCalibration {
  double left = 1.0, right = 1.0;  ///< true travel of a wheel per travel that the firmware counts
  double track_m = 0.0;            ///< true effective track; 0: the model's
  friend bool operator==(const WheelCalibration&, const WheelCalibration&) = default;
};

/// Forward way of the centre and turn, counter-clockwise; or both per second.
struct Progress {
  double way_m = 0.0;
  double turn_rad = 0.0;
};

/// The true progress when the firmware, which reckons with `model_track_m`, counts `counted`. Linear, so that
/// it holds for speeds too.
[[nodiscard]] inline Progress true_progress(const WheelCalibration& wheels, double model_track_m,
                                            const Progress& counted) {
  const double half_m = 0.5 * model_track_m * counted.turn_rad;
  const double left_m = wheels.left * (counted.way_m - half_m);
  const double right_m = wheels.right * (counted.way_m + half_m);
  const double track_m = wheels.track_m > 0.0 ? wheels.track_m : model_track_m;
  return {0.5 * (left_m + right_m), (right_m - left_m) / track_m};
}

/// Inverse of true_progress(): what to command so that the robot makes the progress `wanted`.
[[nodiscard]] inline Progress counted_progress(const WheelCalibration& wheels, double model_track_m,
                                               const Progress& wanted) {
  const double track_m = wheels.track_m > 0.0 ? wheels.track_m : model_track_m;
  const double half_m = 0.5 * track_m * wanted.turn_rad;
  const double left_m = (wanted.way_m - half_m) / wheels.left;
  const double right_m = (wanted.way_m + half_m) / wheels.right;
  return {0.5 * (left_m + right_m), (right_m - left_m) / model_track_m};
}

}  // namespace topo::types

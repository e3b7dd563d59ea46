// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/calibrate.hpp"

namespace topo::calibration {

Calibration calibrate(const DriveLog& drive, const Assumed& assumed, const CalibrationParams& params) {
  const WheelTrack wheels(drive.odometry(), drive.model_track_m());
  const double shared = overlap(params.interval);
  RobotNumbers numbers = assumed.numbers;
  if (!(numbers.wheels.track_m > 0.0)) numbers.wheels.track_m = drive.model_track_m();
  std::vector<ScanPose> poses;
  std::vector<Interval> intervals;
  Calibration out;
  for (int pass = 0; pass < params.passes; ++pass) {
    poses = track_scans(drive, wheels, numbers, params.mapper);
    intervals = make_intervals(poses, params.interval);
    out.fit = fit(wheels, intervals, shared, params.fit);
    if (!out.fit) break;
    numbers = out.fit->numbers;
  }
  if (out.fit) out.shift = find_shift(*out.fit, intervals, shared, params.steadiness, params.fit);
  out.evidence = gather(wheels, poses, intervals, out.fit);
  out.refusals = judge(out.evidence, out.fit, out.shift, drive.model_track_m(), params.verdict);
  if (out.believable())
    out.coronal = fit_coronal(drive, wheels, numbers, assumed.coronal, assumed.front_z_m, params);
  return out;
}

}  // namespace topo::calibration

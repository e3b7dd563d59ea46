// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/calibration/fit.hpp"
#include "core/calibration/scan_track.hpp"
#include "core/calibration/steadiness.hpp"

namespace topo::calibration {

/// What a drive had in it.
struct DriveEvidence {
  double seconds = 0.0;
  double way_m = 0.0;                                    ///< forward and backward, as counted
  double turned_left_rad = 0.0, turned_right_rad = 0.0;  ///< as counted
  std::size_t scans = 0;
  double matched = 0.0;     ///< share of the scans
  double degenerate = 0.0;  ///< share of the scans that leave one direction open
  double response = 0.0;    ///< median: share of a scan's points that fit
  std::size_t intervals = 0;
  double left_out = 0.0;        ///< share of the intervals
  bool against_wheels = false;  ///< the scanner turned to the left where the wheels turned right
};

/// Why a calibration is not believed. Each names what the drive lacked or what was the matter.
enum class Doubt : std::uint8_t {
  kNoOdometry,     ///< no status packets
  kNoScans,        ///< no front scans with odometry around them
  kShort,          ///< too little time
  kNoWay,          ///< it did not drive: the wheels' travel does not show
  kNoTurnLeft,     ///< it did not turn to the left: track and place do not show
  kNoTurnRight,    ///< the same to the right
  kUnmatched,      ///< scans do not fit those before: glass, people, an empty hall
  kDegenerate,     ///< scans leave a direction open: a corridor, one wall
  kPoorFit,        ///< scans fit badly
  kAgainstWheels,  ///< scanner and wheels turn in opposite senses: mirrored, or exchanged motor plugs
  kOpen,           ///< the equations leave a number open
  kSlipped,        ///< too many pieces contradict the rest
  kMoved,          ///< the scanner moved on the robot
  kUncertain,      ///< a number is known too badly
  kImpossible,     ///< a number that no such robot has
};

struct Refusal {
  Doubt doubt = Doubt::kOpen;
  std::optional<Number> number;      ///< of kUncertain and kImpossible
  double found = 0.0, needed = 0.0;  ///< in the unit of what is doubted
};

[[nodiscard]] DriveEvidence gather(const WheelTrack& wheels, std::span<const ScanPose> poses,
                                   std::span<const Interval> intervals, const std::optional<Fit>& fit);

/// Empty: the fit is believable. A cause goes before its effects: a drive that did not turn is refused for
/// that, and not for the number that stays open.
[[nodiscard]] std::vector<Refusal> judge(const DriveEvidence& evidence, const std::optional<Fit>& fit,
                                         const std::optional<Shift>& shift, double model_track_m,
                                         const VerdictParams& params);

}  // namespace topo::calibration

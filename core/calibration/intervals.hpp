// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/calibration/params.hpp"
#include "core/calibration/scan_track.hpp"

namespace topo::calibration {

/// Motion of the front scanner over a piece of the drive, by matching.
struct Interval {
  double from_s = 0.0, to_s = 0.0;
  types::Se2 T_from_to;  ///< of the scanner
};

/// Pieces between matched scans that determine all three directions. They overlap: neighbours are not
/// independent, which the covariance of the fit takes into account.
[[nodiscard]] std::vector<Interval> make_intervals(std::span<const ScanPose> poses,
                                                   const IntervalParams& params);

/// How often each moment is in an interval.
[[nodiscard]] inline double overlap(const IntervalParams& params) {
  return params.length_s / params.stride_s;
}

}  // namespace topo::calibration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/drive_log.hpp"

namespace topo::calibration {

void DriveLog::add(const types::Odometry& odometry) {
  if (odometry_.empty() || odometry.stamp > odometry_.back().stamp) odometry_.push_back(odometry);
}

void DriveLog::add(std::vector<types::Scan>& scans, const types::Scan& scan) const {
  constexpr double kJitter_s = 1e-3;
  if (!scans.empty() &&
      types::to_seconds(scan.first_beam - scans.back().first_beam) < scan_period_s_ - kJitter_s)
    return;
  scans.push_back(scan);
}

}  // namespace topo::calibration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/types/base_state.hpp"
#include "core/types/scan.hpp"

namespace topo::calibration {

/// What was measured on one drive, in order of time.
class DriveLog {
 public:
  /// `model_track_m`: with which the firmware reckons. Scans nearer than `scan_period_s` to the one before
  /// are left out: three minutes of every scan would take 100 MB.
  DriveLog(double model_track_m, double scan_period_s)
      : model_track_m_(model_track_m), scan_period_s_(scan_period_s) {}

  /// Odometry with the model's factors, not calibrated. Samples that are not newer are left out.
  void add(const types::Odometry& odometry);
  void add_front(const types::Scan& scan) { add(front_, scan); }
  void add_coronal(const types::Scan& scan) { add(coronal_, scan); }

  [[nodiscard]] double model_track_m() const { return model_track_m_; }
  [[nodiscard]] const std::vector<types::Odometry>& odometry() const { return odometry_; }
  [[nodiscard]] const std::vector<types::Scan>& front() const { return front_; }
  [[nodiscard]] const std::vector<types::Scan>& coronal() const { return coronal_; }

 private:
  void add(std::vector<types::Scan>& scans, const types::Scan& scan) const;

  double model_track_m_, scan_period_s_;
  std::vector<types::Odometry> odometry_;
  std::vector<types::Scan> front_, coronal_;
};

}  // namespace topo::calibration

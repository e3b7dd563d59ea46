// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <span>

#include "core/pipeline/mapping_losses.hpp"
#include "core/pipeline/odometry_buffer.hpp"
#include "core/types/base_state.hpp"
#include "core/types/scan.hpp"

namespace topo::pipeline {

/// A scan with the poses of base_link in odom at its first and last beam.
struct PairedScan {
  types::Scan scan;
  types::Se2 first, last;
};

types::Stamp end_of(const types::Scan& scan);

/// Pairs scans with the odometry around them. A scan waits until odometry at or after its end is available,
/// or until `wait_s` of scan time has passed.
class ScanPairing {
 public:
  explicit ScanPairing(double wait_s, const MappingStepParams& params = {})
      : wait_s_(wait_s), scans_max_(params.scans_waiting_max), odometry_(params.odometry) {}

  void add(std::span<const types::Odometry> samples);
  /// Scans of one scanner in order; the oldest is dropped and counted when too many wait.
  void add_front(const types::Scan& scan) { push(front_, scan); }
  void add_coronal(const types::Scan& scan) { push(coronal_, scan); }

  /// The next scan with available odometry; nothing when there is none. Drops a scan that no odometry covers.
  /// `flush`: as if the wait were over.
  [[nodiscard]] std::optional<PairedScan> next_front(bool flush) { return next(front_, flush); }
  [[nodiscard]] std::optional<PairedScan> next_coronal(bool flush) { return next(coronal_, flush); }

  [[nodiscard]] const MappingLosses& losses() const { return losses_; }

 private:
  void push(std::deque<types::Scan>& waiting, const types::Scan& scan);
  [[nodiscard]] std::optional<PairedScan> next(std::deque<types::Scan>& waiting, bool flush);

  double wait_s_;
  std::size_t scans_max_;  // of one scanner
  OdometryBuffer odometry_;
  std::deque<types::Scan> front_, coronal_;
  types::Stamp newest_{};  // end of the newest scan, either scanner
  MappingLosses losses_;
};

}  // namespace topo::pipeline

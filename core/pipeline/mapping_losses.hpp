// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace topo::pipeline {

/// Scans that did not reach the map, by reason.
struct MappingLosses {
  std::uint64_t without_odometry = 0;  ///< no dead reckoning was received yet
  std::uint64_t queue_full = 0;        ///< too many scans waited for odometry

  MappingLosses& operator+=(const MappingLosses& more) {
    without_odometry += more.without_odometry;
    queue_full += more.queue_full;
    return *this;
  }
  friend MappingLosses operator-(const MappingLosses& later, const MappingLosses& earlier) {
    return {later.without_odometry - earlier.without_odometry, later.queue_full - earlier.queue_full};
  }
};

}  // namespace topo::pipeline

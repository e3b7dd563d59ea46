// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "core/types/stamp.hpp"

namespace topo::io {

/// How long data waited on a line, beyond the shortest wait so far: of arrival - device time the smallest
/// value since the stream began, which may rise only as fast as two clocks drift apart. A delay that grows
/// faster cannot be taken for drift, however slowly it grows. A delay that was there from the beginning
/// cannot be observed from one side.
class LineAge {
 public:
  /// `rise`: greatest drift of the two clocks, seconds per second.
  explicit LineAge(double rise) : rise_(rise) {}

  void reset() { started_ = false; }
  /// Begins with a known difference, of a round trip.
  void begin(types::Duration difference, types::Stamp now) {
    floor_ = difference;
    last_ = now;
    started_ = true;
  }
  /// `difference`: arrival - device time of the newest data. Returns the wait, never negative.
  types::Duration update(types::Duration difference, types::Stamp now) {
    if (!started_) begin(difference, now);
    const types::Duration elapsed = std::max(now - last_, types::Duration::zero());
    floor_ = std::min(floor_ + types::from_seconds(rise_ * types::to_seconds(elapsed)), difference);
    last_ = now;
    return difference - floor_;
  }

 private:
  double rise_;
  bool started_ = false;
  types::Duration floor_{};
  types::Stamp last_{};
};

}  // namespace topo::io

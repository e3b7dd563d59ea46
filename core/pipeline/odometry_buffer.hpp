// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "core/types/base_state.hpp"

namespace topo::pipeline {

/// The last seconds of dead reckoning, to be asked for any instant within.
class OdometryBuffer {
 public:
  /// Samples not newer than the last one are left out.
  void add(const types::Odometry& odometry);

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  /// Is there a sample at or after the stamp?
  [[nodiscard]] bool covers(types::Stamp stamp) const { return !empty() && samples_.back().stamp >= stamp; }

  /// Pose of base_link in odom: interpolated between samples; after the last one carried on with its twist
  /// for at most `kCarryOn`, before the first one that sample. Nothing when empty.
  [[nodiscard]] std::optional<types::Se2> at(types::Stamp stamp) const;

 private:
  static constexpr types::Duration kKeep = std::chrono::seconds(3);
  static constexpr types::Duration kCarryOn = std::chrono::milliseconds(300);
  std::deque<types::Odometry> samples_;
};

}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "core/pipeline/mapping_params.hpp"
#include "core/types/base_state.hpp"

namespace topo::pipeline {

/// The last seconds of dead reckoning, for queries at any time within them.
class OdometryBuffer {
 public:
  explicit OdometryBuffer(const OdometryBufferParams& params = {}) : params_(params) {}
  /// Ignores samples that are not newer than the last one.
  void add(const types::Odometry& odometry);

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  /// True when a sample at or after the stamp exists.
  [[nodiscard]] bool covers(types::Stamp stamp) const { return !empty() && samples_.back().stamp >= stamp; }

  /// Pose of base_link in odom: interpolated between samples; after the last sample extrapolated with its
  /// twist for at most OdometryBufferParams::extrapolated_max; before the first sample equal to it. Nothing
  /// when empty.
  [[nodiscard]] std::optional<types::Se2> at(types::Stamp stamp) const;

 private:
  OdometryBufferParams params_;
  std::deque<types::Odometry> samples_;
};

}  // namespace topo::pipeline

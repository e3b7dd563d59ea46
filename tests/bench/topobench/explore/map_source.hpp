// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/pipeline/mapping_step.hpp"
#include "core/pipeline/planning_step.hpp"
#include "tests/bench/topobench/explore/readings.hpp"

namespace topo::bench {

/// What the mapping and loop closure threads do, in lock-step.
class MapSource {
 public:
  virtual ~MapSource() = default;
  virtual void take(const Readings& readings) = 0;
  /// The newest snapshot, never null. Good until the next take().
  [[nodiscard]] virtual const pipeline::MapSnapshot& map() const = 0;
  [[nodiscard]] virtual const pipeline::TrackedPose& tracked() const = 0;
};

/// The mapper on every scan. A loop question is answered exactly `closure_delay_scans` front scans later.
std::unique_ptr<MapSource> make_slam_source(const slam::MapperParams& params, int closure_delay_scans);

/// Fidelity "plan": keyframes at the poses of Readings::poses, drawn by the mapper's own map builder.
std::unique_ptr<MapSource> make_posed_source(const slam::MapperParams& params);

}  // namespace topo::bench

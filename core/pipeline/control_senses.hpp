// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/motion/breadcrumb_path.hpp"
#include "core/motion/velocity_gate.hpp"
#include "core/perception/blind_spot.hpp"
#include "core/perception/moving_obstacles.hpp"
#include "core/perception/steady_frame.hpp"
#include "core/pipeline/control_step.hpp"

namespace topo::pipeline {

/// What control perceives: the newest scan with what was seen before where the scanner does not look now,
/// what moves, and the way the robot came. Allocates nothing. One thread.
class ControlSenses {
 public:
  /// Everything that the gate looks at, for this period; no request yet. The spans are good until the next
  /// call.
  motion::GateInput perceive(const ControlSetup& setup, const ControlInput& in);

  /// The last metre that the robot drove.
  [[nodiscard]] const motion::BreadcrumbPath& breadcrumbs() const { return breadcrumbs_; }
  /// How far straight back the ground was seen free, metres, at most Recovery::kSeenBehind_m.
  [[nodiscard]] double seen_behind_m(const motion::GateInput& gate_in) const;

 private:
  void follow_drift(const std::optional<types::Se2>& T_map_base, const ControlInput& in);
  void drive_on(const ControlInput& in);
  [[nodiscard]] std::span<const perception::MovingObstacle> moving(const ControlSetup& setup,
                                                                   const ControlInput& in);
  [[nodiscard]] std::span<const perception::ScanPoint> points(
      const ControlSetup& setup, const ControlInput& in,
      std::span<const perception::MovingObstacle> moving_now);

  perception::SteadyFrame steady_frame_;  // of the breadcrumbs and of the blind spot
  std::uint64_t steady_plan_ = 0;         // the last plan that it was corrected by
  motion::BreadcrumbPath breadcrumbs_;
  types::Stamp breadcrumbs_stamp_{};
  perception::BlindSpot blind_spot_;
  perception::MovingObstacles tracker_;
  std::array<perception::MovingObstacle, perception::MovingObstacles::kMax> moving_{};
  /// What the scanner saw before, and from BlindSpot::kMax on what it sees.
  std::array<perception::ScanPoint, perception::BlindSpot::kMax + types::Scan::kMaxBeams> points_{};
};

/// The robot's pose in map by the newest plan, which has to be fresh, and made by a planner that knew the
/// place. A plan to stand is fresh as well when the place is not known.
std::optional<types::Se2> place_by_plan(const ControlSetup& setup, const ControlInput& in);

/// What only sonar noticed, into the report.
void report_unseen(const motion::GateInput& gate_in, ControlReport& report);

}  // namespace topo::pipeline

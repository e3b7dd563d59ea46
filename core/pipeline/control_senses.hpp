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
#include "core/perception/own_echo.hpp"
#include "core/perception/steady_frame.hpp"
#include "core/pipeline/control_step.hpp"

namespace topo::pipeline {

/// The perception of control: the newest scan, completed by earlier points outside the scanner's present
/// field of view, moving obstacles, and the breadcrumb path. Allocates nothing. One thread.
class ControlSenses {
 public:
  explicit ControlSenses(const perception::PerceptionParams& perception = {},
                         const motion::MotionParams& motion = {});
  /// The gate's complete input for this period, without a request. The spans are valid until the next call.
  motion::GateInput perceive(const ControlSetup& setup, const ControlInput& in);

  /// The last metre that the robot drove.
  [[nodiscard]] const motion::BreadcrumbPath& breadcrumbs() const { return breadcrumbs_; }
  [[nodiscard]] const perception::OwnEcho& own_echo() const { return own_echo_; }
  /// Length straight behind the robot where the ground was observed free, metres, at most
  /// `most_m`.
  [[nodiscard]] double seen_behind_m(const motion::GateInput& gate_in, double most_m) const;

 private:
  void follow_drift(const std::optional<types::Se2>& T_map_base, const ControlInput& in);
  void drive_on(const ControlInput& in);
  [[nodiscard]] std::span<const perception::MovingObstacle> moving(const ControlSetup& setup,
                                                                   const ControlInput& in);
  [[nodiscard]] std::span<const perception::ScanPoint> points(
      const ControlSetup& setup, const ControlInput& in,
      std::span<const perception::MovingObstacle> moving_now);

  perception::StopZoneParams stop_zone_;
  motion::GateParams gate_;
  perception::SteadyFrame steady_frame_;  // of the breadcrumb path and of the blind spot
  std::uint64_t steady_plan_ = 0;         // the last plan that corrected it
  motion::BreadcrumbPath breadcrumbs_;
  types::Stamp breadcrumbs_stamp_{};
  perception::BlindSpot blind_spot_;
  perception::OwnEcho own_echo_;
  perception::MovingObstacles tracker_;
  std::array<perception::MovingObstacle, perception::MovingObstacles::kMax> moving_{};
  /// Points seen before, and from BlindSpot::kMax on those of the present scan.
  std::array<perception::ScanPoint, perception::BlindSpot::kMax + types::Scan::kMaxBeams> points_{};
};

/// The robot's pose in map by the newest plan, which must be fresh and made with a known robot pose. A plan
/// to stand can be fresh without one.
std::optional<types::Se2> place_by_plan(const ControlSetup& setup, const ControlInput& in);

/// Writes into the report what only sonar detects.
void report_unseen(const motion::GateInput& gate_in, const perception::UnseenEchoParams& params,
                   ControlReport& report);

}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include "core/motion/params.hpp"
#include "core/perception/params.hpp"
#include "core/plausibility/params.hpp"
#include "core/types/stamp.hpp"

namespace topo::pipeline {

/// Between a plan and the motion along it (plan_following.hpp). Chosen on simulated explorations
/// (doc/results.md).
struct PlanFollowingParams {
  double obstacle_reach_m = 2.8;     ///< at least; farther where the free path needed is longer
  double obstacle_spacing_m = 0.03;  ///< of the points that arcs are compared by: the noise of a range; in
                                     ///< proportion where they reach farther
  double same_end_m = 0.2;           ///< between the ends of two paths to the same goal
  double beside_m = 1.5;  ///< a moving obstacle within this distance holds up a robot without a free path
  /// A wanted turn on the spot of which the gate leaves less than this takes time and leads nowhere.
  double turns_radps = 0.3, hardly_radps = 0.08;
};

/// The parameters of control_step(), by the folder that uses them.
struct ControlParams {
  plausibility::PlausibilityParams plausibility;
  perception::PerceptionParams perception;
  motion::MotionParams motion;
  PlanFollowingParams following;
  types::Duration motors_linger = std::chrono::seconds(10);  ///< delay before unused motors are switched off
};

}  // namespace topo::pipeline

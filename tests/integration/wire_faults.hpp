// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tests/integration/wire_rig.hpp"

namespace topo::test {

/// What is known at one time of the world and of what the daemon says.
struct Evidence {
  Moment moment;
  Json status;
};

enum class Outcome {
  kStops,           ///< stands within the stopping distance until the fault is over, then goes on by itself
  kDrivesOn,        ///< and stops before what appears, with the fault still there
  kTouchesNothing,  ///< may do either; stops before what appears
};

/// One thing that toposim can do to a robot.
struct WireFault {
  std::string name;
  std::vector<Json> strike;  ///< toposim's commands
  std::vector<Json> lift;    ///< empty: it passes by itself
  Outcome outcome = Outcome::kStops;
  /// kStops: from the blow until zero velocity is commanded, or the firmware stops by itself.
  double noticed_s = 0.0;
  /// By the daemon's own words, or by the device's where the daemon cannot know: it did strike.
  bool (*has_struck)(const Evidence& before, const Evidence& now) = nullptr;
  bool box_after = true;  ///< where it drives on: a box appears 1 m ahead, with the fault still there
};

std::ostream& operator<<(std::ostream& out, const WireFault& fault);

std::vector<WireFault> front_faults();
std::vector<WireFault> coronal_faults();
std::vector<WireFault> base_faults();

/// How far a robot may roll from a blow at v: at full speed until the fault is noticed, one period of the
/// base thread and the command's way to the wheels, then braking as configured; 5 cm for the wheels' error of
/// 2 % and the quantisation of commands. All from the configuration and DESIGN "Motion and safety"; `late_s`
/// is what the test machine was late by, once in the daemon and once in the simulator.
double stopping_distance_m(double v_mps, double noticed_s, double late_s);

}  // namespace topo::test

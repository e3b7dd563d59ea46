// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/plausibility/doubt.hpp"
#include "tests/integration/drive_rig.hpp"

namespace topo::test {

/// A fault of values on their way between the robot and the base thread's step, in lock-step.
struct ValueFault {
  std::string name;                          ///< as in the table: "device: what is wrong"
  std::optional<plausibility::Doubt> doubt;  ///< that it has to raise; none: no doubt may rise
  std::function<void(DriveRig&)> begin;
  double box_after_s = 1.5;      ///< from the fault until a box appears 1 m ahead
  bool latches = false;          ///< the operator has to clear it
  bool perhaps_doubted = false;  ///< doubts other than `doubt` may rise, or none when it is empty
};

/// Faults in which everything arrives, in form and in time, and is wrong; the first and the last are none.
std::vector<ValueFault> lies();
/// Silence, and what the robot itself reports.
std::vector<ValueFault> plain_faults();
/// Ends whatever fault there is.
void heal(DriveRig& rig);

/// Scan matching without errors, of the odometry that was given: DriveRig::match.
struct Matcher {
  const DriveRig& rig;
  bool other_robots = false;  ///< the scanner is on a robot that stands
  bool upside_down = false;
  double carried_mps = 0.0;  ///< to the left, over and above what the wheels do
  plausibility::MatchedMotion motion{};
  sim::Se2 last{};

  explicit Matcher(const DriveRig& of) : rig(of), last(of.body().truth()) {}
  plausibility::MatchedMotion operator()();
};

/// DriveRig::carry of a base that hears its commands, and obeys none.
void swallow(const types::BaseCommand& command, bench::VirtualBase& base, sim::SimTime now);

}  // namespace topo::test

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "core/types/stamp.hpp"
#include "core/types/transform.hpp"

namespace topo::types {

/// Dead reckoning of the base at one instant.
struct Odometry {
  Stamp stamp{};  ///< when the pose was valid (transmission delay removed)
  Transform2<Odom, Base> T_odom_base;
  Twist2 twist;
};

/// One sonar echo, at the index of its transducer.
struct SonarReading {
  Stamp stamp{};         ///< of the packet that contained it; 0: never received
  float range_m = 0.0F;  ///< at or beyond the maximum range: no echo
};

/// Contents of one status packet of the base, in SI units.
struct BaseState {
  static constexpr std::size_t kMaxSonars = 32;

  Odometry odometry;
  Stamp arrival{};  ///< when its last byte was read; staleness is measured from it
  /// How much longer than the fastest packets of its connection the packet waited on its line.
  Duration late{};
  /// From the newest answered request to its answer; 0: the base answers none.
  Duration round_trip{};
  std::uint64_t sequence = 0;  ///< status packets since the daemon's start
  bool motors_enabled = false;
  bool stop_button = false;
  bool stall_left = false;
  bool stall_right = false;
  std::uint8_t bumpers_front = 0;  ///< bit i: segment i + 1
  std::uint8_t bumpers_rear = 0;
  float battery_v = 0.0F;
  float state_of_charge = -1.0F;  ///< 0..1; negative: not reported
  bool charging = false;
  std::array<SonarReading, kMaxSonars> sonar{};
};

/// Command to the base, sent every control period.
struct BaseCommand {
  Twist2 twist;
  bool enable_motors = false;
  bool estop = false;  ///< stop at maximum deceleration; overrides everything else
  /// The base does not obey: E_STOP, and then nothing, so that the firmware's watchdog stops it. Nor may a
  /// new connection send anything.
  bool silence = false;
};

}  // namespace topo::types

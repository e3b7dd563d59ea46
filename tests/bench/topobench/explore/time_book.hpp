// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/pipeline/control_step.hpp"

namespace topo::bench {

/// What a robot does at a moment of its mission.
enum class Doing : std::uint8_t {
  kFullSpeed,  ///< within 5 % of the permitted speed
  kSlower,
  kTurning,   ///< on the spot
  kStanding,  ///< for any other reason
  kWaiting,   ///< for something to move away, or for team-mates
};
inline constexpr std::size_t kDoings = 5;
inline constexpr std::array<const char*, kDoings> kDoingNames{"full_speed", "slower", "turning", "standing",
                                                              "waiting"};

/// Why a robot is slower than permitted.
enum class Loss : std::uint8_t {
  kTurning,
  kSpeedingUp,
  kBraking,
  kObstacle,       ///< the gate slows for what is ahead or beside
  kCurveOrNarrow,  ///< the follower asks for less
  kRecovery,
  kWaiting,
  kNoGoal,   ///< stands without a way to go
  kStopped,  ///< the gate or a doubt stops it
};
inline constexpr std::size_t kLosses = 9;
inline constexpr std::array<const char*, kLosses> kLossNames{"turning",  "speeding_up",     "braking",
                                                             "obstacle", "curve_or_narrow", "recovery",
                                                             "waiting",  "no_goal",         "stopped"};

/// One period of control.
struct Moment {
  double dt_s = 0.0;
  types::Twist2 twist;         ///< as the robot truly moves
  double permitted_mps = 0.0;  ///< the most that the limits allow
  pipeline::ControlMode mode = pipeline::ControlMode::kStanding;
  motion::GateReason reason = motion::GateReason::kFree;
  bool has_way = false;  ///< planning gave one
};

/// Where the time of a mission goes, in seconds. `lost_s`: what driving the same way at the permitted speed
/// would have saved, by reason.
struct TimeSpent {
  std::array<double, kDoings> doing_s{};
  std::array<double, kLosses> lost_s{};

  [[nodiscard]] double all_s() const;
  TimeSpent& operator+=(const TimeSpent& other);
};

/// Adds up moments. Speeding up and braking are told by the moment before.
class TimeBook {
 public:
  void add(const Moment& moment);
  [[nodiscard]] const TimeSpent& spent() const { return spent_; }

 private:
  TimeSpent spent_;
  double last_mps_ = 0.0;
};

}  // namespace topo::bench

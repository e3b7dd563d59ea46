// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>

#include "core/types/stamp.hpp"

namespace topo::plausibility {

/// What a base that follows its commands at once would do (command_history.hpp).
struct CommandHistoryParams {
  double elapsed_max_s = 0.2;  ///< four periods: a later one must not count as a long ramp
};

/// Measured deceleration (braking.hpp).
struct BrakingParams {
  double top_mps = 0.3;  ///< slower stops are over within a few statuses
  /// Of the speed at which a stop began: between these two it is measured.
  double fast_share = 0.8, slow_share = 0.2;
  double forget = 0.2;      ///< weight of a better stop: one bad stop counts at once
  double weak_share = 0.8;  ///< of the believed deceleration: less is weak
};

/// Commanded against measured speed.
struct ObedienceParams {
  /// Longest lag of a base that is driven: the control loop assumes RobotLimits::reaction, 100 ms, and the
  /// status arrives up to a cycle of 100 ms later; the rest is margin.
  types::Duration lag_max = std::chrono::milliseconds(300);
  double v_tolerance_mps = 0.12;       ///< wheels err by 2 %; overshoot of the firmware's controller
  double omega_tolerance_radps = 0.5;  ///< the same; RVEL is quantised to 1 deg/s
  double braking_share = 0.5;          ///< of the believed deceleration that a base may brake with at least
  int statuses = 3;                    ///< in a row outside the bounds: one may be a bump
  /// Within the tolerances, a base that is commanded to stand still may roll, but not go on: a swallowed stop
  /// of a slow robot. Wheels that stand report 0; encoders err by a few mm/s.
  double creep_mps = 0.03, creep_radps = 0.06;
  types::Duration creep_for = std::chrono::seconds(2);  ///< rolling out, or a push
  /// A change of the command within the last seconds that is enough to measure the lag by.
  double informative_mps = 0.15;
  int informative_statuses = 6;  ///< from which the lag counts: 0.6 s at 10 Hz
  double lag_forgetting = 0.97;  ///< weight of the past, per informative status
  double lag_error_mps = 0.03;   ///< error of the best admissible lag from which a longer one is believed,
  double lag_gain = 0.5;         ///< when its squared error is at most this share
  double arm_m = 0.2;            ///< turns a rotation into the speed of a wheel: half of a track, about
};

/// Reported motion against the model.
struct MotionParams {
  double speed_factor = 1.3;       ///< of the catalogue's top speed: downhill, or pushed
  double v_slack_mps = 0.3;        ///< between reported speed and change of the pose
  double omega_slack_radps = 0.6;  ///< the same: heading is quantised and gyro-corrected
  double step_m = 0.08;            ///< a correction of the firmware's pose
  double step_rad = 0.15;
};

/// Odometry against scan matching, over windows of matched scans.
struct MatchParams {
  types::Duration window = std::chrono::milliseconds(1000);
  double floor_m = 0.15;  ///< difference of two good measurements: matches err by 0.03 m, wheels slip
  double share_m = 0.35;  ///< of the distance: carpets, inflated tyres
  double floor_rad = 0.2;
  double share_rad = 0.4;  ///< a P3-AT skids when it turns
  int windows = 2;         ///< in a row
};

/// The front scanner's picture. Forward: within 90 degrees of the robot's heading.
struct PictureParams {
  double blind_share = 0.95;  ///< of the forward beams without a return; or failed
  types::Duration blind_for = std::chrono::seconds(1);
  bool open_space = false;  ///< true: a place without walls in range is normal
  /// Equal to the bit; real ranges have noise of millimetres. A picture without any range, which has no
  /// noise, is blind, failed or covered after so many.
  std::uint64_t frozen_pictures = 10;
  bool noiseless = false;      ///< true: equal pictures are normal (a simulator without noise)
  double covered_share = 0.2;  ///< of the forward beams nearer than covered_m
  double covered_m = 0.08;     ///< from the scanner's centre: its own window
  types::Duration covered_for = std::chrono::seconds(1);
};

/// Motors that go off (motors_check.hpp).
struct MotorsParams {
  /// Wanted for less, they may go off by the host's own request before, which shows within
  /// ObedienceParams::lag_max and a status cycle.
  types::Duration wanted_for = std::chrono::milliseconds(500);
};

/// Which robot counts as standing, and which as newly connected.
struct StandingParams {
  double v_mps = 0.02, omega_radps = 0.05;  ///< slower counts as standing
  /// A base that was silent for longer has a new connection: five status cycles end one.
  types::Duration silence = std::chrono::milliseconds(500);
};

struct PlausibilityParams {
  CommandHistoryParams commands;
  BrakingParams braking;
  StandingParams standing;
  ObedienceParams obedience;
  MotionParams motion;
  MotorsParams motors;
  MatchParams match;
  PictureParams picture;
  /// Longest wait of data on a line, beyond its shortest (types::Scan::late, types::BaseState::late).
  types::Duration late_max = std::chrono::milliseconds(300);
  /// Longest time from a request to the base's answer (types::BaseState::round_trip):
  /// ObedienceParams::lag_max and a status cycle, by which an answer may wait behind a status on a slow line.
  types::Duration round_trip_max = std::chrono::milliseconds(400);
  types::Duration hold = std::chrono::seconds(1);  ///< a doubt lasts this long after its cause
  /// A base that does not obey and is not heard for so long is taken to stand when the operator says so: the
  /// gate lets none drive whose watchdog takes more than 2 s, and from 1.2 m/s it brakes in 2.4 s.
  types::Duration unheard_stands = std::chrono::seconds(5);
  int strikes = 3;                                       ///< the same doubt so often within
  types::Duration strikes_in = std::chrono::minutes(1);  ///< this time lasts until the operator clears it
};

}  // namespace topo::plausibility

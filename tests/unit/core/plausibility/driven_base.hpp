// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>

#include "core/plausibility/command_history.hpp"
#include "core/types/base_state.hpp"
#include "core/types/robot_limits.hpp"

namespace topo::plausibility::testing {

/// A base in lock-step: takes a command every 50 ms, follows it after a lag with its own acceleration and
/// braking, and gives a status every 100 ms, with noise of the encoders.
class DrivenBase {
 public:
  types::Duration lag = std::chrono::milliseconds(100);
  double braking_mps2 = 0.5;
  bool obeys = true;
  types::BaseState state;
  types::Stamp now = types::stamp_from_seconds(100.0);

  explicit DrivenBase(std::uint32_t seed = 1) : random_(seed) { state.motors_enabled = true; }

  /// One control period. True when `state` is new.
  bool step(const types::Twist2& commanded) {
    now += types::kBasePeriod;
    sent_.push_back({now, commanded});
    while (obeys && !sent_.empty() && sent_.front().stamp + lag <= now) {
      target_ = sent_.front().twist;
      sent_.pop_front();
    }
    const double dt = types::to_seconds(types::kBasePeriod);
    const double rate = std::abs(target_.v_mps) < std::abs(v_mps_) ? braking_mps2 : 0.3;
    v_mps_ += std::clamp(target_.v_mps - v_mps_, -rate * dt, rate * dt);
    omega_radps_ += std::clamp(target_.omega_radps - omega_radps_, -1.7 * dt, 1.7 * dt);
    const types::Se2 arc{v_mps_ * dt, 0.0, omega_radps_ * dt};
    T_odom_base_ = T_odom_base_ * arc;
    if (++periods_ % 2 != 0) return false;
    std::normal_distribution<double> noise(0.0, 0.01);
    state.odometry = {now,
                      types::Transform2<types::Odom, types::Base>(T_odom_base_),
                      {v_mps_ + noise(random_), omega_radps_ + noise(random_)}};
    state.arrival = now;
    ++state.sequence;
    return true;
  }
  [[nodiscard]] double v_mps() const { return v_mps_; }
  void push(double v_mps) { v_mps_ = v_mps; }

 private:
  struct Sent {
    types::Stamp stamp;
    types::Twist2 twist;
  };
  std::mt19937 random_;
  std::deque<Sent> sent_;
  types::Twist2 target_;
  double v_mps_ = 0.0, omega_radps_ = 0.0;
  types::Se2 T_odom_base_;
  int periods_ = 0;
};

/// What the gate commands towards a wanted twist: ramps of the usual limits.
class Ramp {
 public:
  types::Twist2 towards(const types::Twist2& wanted) {
    const double dt = types::to_seconds(types::kBasePeriod);
    const double rate = std::abs(wanted.v_mps) < std::abs(last_.v_mps) ? 0.5 : 0.3;
    last_.v_mps += std::clamp(wanted.v_mps - last_.v_mps, -rate * dt, rate * dt);
    last_.omega_radps += std::clamp(wanted.omega_radps - last_.omega_radps, -1.7 * dt, 1.7 * dt);
    return last_;
  }
  void stop() { last_ = {}; }

 private:
  types::Twist2 last_;
};

}  // namespace topo::plausibility::testing

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/time_book.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace topo::bench {
namespace {

using motion::GateReason;
using pipeline::ControlMode;

constexpr double kFull = 0.95;
constexpr double kStill_mps = 0.02;
constexpr double kTurn_radps = 0.05;
constexpr double kRamp_mps2 = 0.1;  // slower changes of speed are the follower's

bool is_waiting(const Moment& moment) {
  return moment.mode == ControlMode::kWaiting || moment.reason == GateReason::kGivesWay;
}

bool is_held_by_gate(GateReason reason) {
  return reason != GateReason::kFree && reason != GateReason::kLimited && reason != GateReason::kSlowed;
}

Doing doing_at(const Moment& moment) {
  const double speed_mps = std::abs(moment.twist.v_mps);
  if (speed_mps >= kFull * moment.permitted_mps) return Doing::kFullSpeed;
  if (speed_mps > kStill_mps) return Doing::kSlower;
  if (std::abs(moment.twist.omega_radps) > kTurn_radps) return Doing::kTurning;
  return is_waiting(moment) ? Doing::kWaiting : Doing::kStanding;
}

Loss loss_at(const Moment& moment, Doing doing, double change_mps2) {
  if (moment.mode == ControlMode::kRecovering || moment.mode == ControlMode::kStuck) return Loss::kRecovery;
  if (doing == Doing::kTurning) return Loss::kTurning;
  if (is_waiting(moment)) return Loss::kWaiting;
  if (!moment.has_way && doing == Doing::kStanding) return Loss::kNoGoal;
  if (is_held_by_gate(moment.reason)) return Loss::kStopped;
  if (change_mps2 > kRamp_mps2) return Loss::kSpeedingUp;
  if (change_mps2 < -kRamp_mps2) return Loss::kBraking;
  return moment.reason == GateReason::kSlowed ? Loss::kObstacle : Loss::kCurveOrNarrow;
}

}  // namespace

double TimeSpent::all_s() const { return std::accumulate(doing_s.begin(), doing_s.end(), 0.0); }

TimeSpent& TimeSpent::operator+=(const TimeSpent& other) {
  for (std::size_t i = 0; i < kDoings; ++i) doing_s[i] += other.doing_s[i];
  for (std::size_t i = 0; i < kLosses; ++i) lost_s[i] += other.lost_s[i];
  return *this;
}

void TimeBook::add(const Moment& moment) {
  if (!(moment.dt_s > 0.0 && moment.permitted_mps > 0.0)) return;
  const Doing doing = doing_at(moment);
  const double change_mps2 = (moment.twist.v_mps - last_mps_) / moment.dt_s;
  const double share = std::clamp(1.0 - std::abs(moment.twist.v_mps) / moment.permitted_mps, 0.0, 1.0);
  spent_.doing_s[static_cast<std::size_t>(doing)] += moment.dt_s;
  spent_.lost_s[static_cast<std::size_t>(loss_at(moment, doing, change_mps2))] += share * moment.dt_s;
  last_mps_ = moment.twist.v_mps;
}

}  // namespace topo::bench

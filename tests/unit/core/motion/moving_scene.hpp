// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "core/motion/velocity_gate.hpp"
#include "core/perception/footprint_sweep.hpp"
#include "core/perception/moving_obstacles.hpp"
#include "tests/unit/core/motion/surroundings.hpp"

namespace topo::motion {

/// A cylinder, or a leg, that goes straight on. Legs swing: half a stride ahead and behind by turns.
struct Walking {
  types::Vector2 at{0.0, 0.0};  ///< when the scene's time is 0
  types::Vector2 velocity_mps{0.0, 0.0};
  double radius_m = 0.2;
  double swing_m = 0.0;
  double swing_phase_rad = 0.0;
  [[nodiscard]] types::Vector2 centre(double t_s) const {
    const double speed_mps = velocity_mps.norm();
    types::Vector2 p = at + t_s * velocity_mps;
    if (speed_mps > 0.0)
      p += swing_m * std::sin(2.0 * std::numbers::pi * t_s + swing_phase_rad) / speed_mps * velocity_mps;
    return p;
  }
};

struct Wall {
  types::Vector2 from{0.0, 0.0}, to{0.0, 0.0};
};

/// A P3-DX with a UTM-30LX among walls and walkers: scans of 1081 beams with noise, each beam at its own
/// time; reckoning ten times a second, 40 ms late, of wheels that are wrong; the firmware's ramps behind a
/// delay.
class MovingScene {
 public:
  explicit MovingScene(unsigned seed) : random_(seed) {
    limits.footprint = {0.210, 0.301, 0.2125, 0.267};
    scan_->beams = 1081;
  }

  std::vector<Wall> walls;
  std::vector<Walking> walkers;
  types::RobotLimits limits;
  types::Twist2 wanted;
  double track_error = 0.05, slip = 0.0;  ///< part by which the left wheel turns in vain
  bool free_of_gate = false;              ///< drives as it wants
  bool takes_all_for_standing = false;    ///< the gate is not told what moves
  types::Se2 pose;
  types::Twist2 twist;

  [[nodiscard]] double now_s() const { return now_s_; }
  [[nodiscard]] std::span<const perception::MovingObstacle> moving() const {
    return {found_.data(), found_count_};
  }
  [[nodiscard]] const GateOutput& out() const { return out_; }
  /// From the hull to the nearest walker, metres.
  [[nodiscard]] double gap_m() const {
    double gap = HUGE_VAL;
    for (const Walking& w : walkers)
      gap = std::min(
          gap, perception::distance_m(pose.inverse() * w.centre(now_s_), limits.footprint) - w.radius_m);
    return gap;
  }
  /// Drives as it is wanted, from the first moment.
  void set_off() { gate_.last = twist = wanted; }
  /// One period of the base thread.
  void step() {
    constexpr int kSteps = 5;
    control();
    for (int i = 0; i < kSteps; ++i) drive(0.05 / kSteps);
  }

 private:
  static constexpr double kEpoch_s = 100.0;
  [[nodiscard]] types::Stamp stamp(double t_s) const { return types::stamp_from_seconds(kEpoch_s + t_s); }

  void drive(double dt_s) {
    commands_.push_back({now_s_, out_.command});
    while (commands_.size() > 1 && commands_[1].at_s <= now_s_ - kDelay_s) commands_.pop_front();
    types::BaseCommand command = commands_.front().command;
    if (commands_.front().at_s > now_s_ - kDelay_s) command = {};
    const double brake = command.estop ? 1.5 : limits.deceleration_mps2;
    if (command.estop) command.twist = {};
    twist.v_mps = ramped(twist.v_mps, command.twist.v_mps, limits.acceleration_mps2, brake, dt_s);
    twist.omega_radps = ramped(twist.omega_radps, command.twist.omega_radps,
                               limits.angular_acceleration_radps2, limits.angular_acceleration_radps2, dt_s);
    const auto on = [dt_s](const types::Se2& from, double v, double w) {
      return from *
             types::Se2{v * dt_s * std::cos(0.5 * w * dt_s), v * dt_s * std::sin(0.5 * w * dt_s), w * dt_s};
    };
    constexpr double kTrack_m = 0.36;
    const double lost_mps = slip * (twist.v_mps - 0.5 * kTrack_m * twist.omega_radps);
    reckoned_ = on(reckoned_, twist.v_mps, twist.omega_radps);
    pose =
        on(pose, twist.v_mps - 0.5 * lost_mps, twist.omega_radps * (1.0 - track_error) + lost_mps / kTrack_m);
    past_.push_back({now_s_ += dt_s, pose});
    while (past_.size() > 20) past_.pop_front();
    if (now_s_ - told_s_ < 0.1 - 1e-9) return;
    told_s_ = now_s_;
    types::BaseState state;
    state.odometry = {stamp(now_s_), types::Transform2<types::Odom, types::Base>(reckoned_), twist};
    state.arrival = stamp(now_s_ + 0.04);
    on_the_way_.push_back(state);
  }

  [[nodiscard]] types::Se2 pose_then(double t_s) const {
    for (std::size_t i = 1; i < past_.size(); ++i)
      if (past_[i].at_s >= t_s) {
        const double part = (t_s - past_[i - 1].at_s) / (past_[i].at_s - past_[i - 1].at_s);
        return types::interpolate(past_[i - 1].pose, past_[i].pose, std::clamp(part, 0.0, 1.0));
      }
    return pose;
  }

  void look() {
    const double first_s = now_s_ - 0.025;
    *scan_ = *empty_scan(stamp(first_s));
    scan_->arrival = stamp(now_s_);
    std::normal_distribution<double> noise(0.0, 0.03);
    std::uniform_real_distribution<double> chance;
    for (std::size_t i = 0; i < scan_->beams; ++i) {
      const double t_s =
          first_s + static_cast<double>(scan_->geometry.time_increment_s) * static_cast<double>(i);
      const types::Se2 at = pose_then(t_s) * T_base_laser_;
      const double range_m = cast(at, static_cast<double>(scan_->angle_rad(i)), t_s);
      if (chance(random_) < 0.005)
        scan_->range_m[i] = types::kInvalid;
      else if (range_m < 30.0)
        scan_->range_m[i] = static_cast<float>(range_m + noise(random_));
    }
  }

  [[nodiscard]] double cast(const types::Se2& at, double bearing_rad, double t_s) const {
    const types::Vector2 o = at.translation();
    const double angle = at.theta_rad + bearing_rad;
    const types::Vector2 d(std::cos(angle), std::sin(angle));
    double best = HUGE_VAL;
    for (const Wall& w : walls) {
      const types::Vector2 e = w.to - w.from, f = w.from - o;
      const double det = e.x() * d.y() - e.y() * d.x();
      if (std::abs(det) < 1e-12) continue;
      const double t = (e.x() * f.y() - e.y() * f.x()) / det, u = (d.x() * f.y() - d.y() * f.x()) / det;
      if (t > 0.0 && u >= 0.0 && u <= 1.0) best = std::min(best, t);
    }
    for (const Walking& w : walkers) {
      const types::Vector2 f = w.centre(t_s) - o;
      const double along = f.dot(d), square = f.squaredNorm() - along * along;
      if (along > 0.0 && square < w.radius_m * w.radius_m)
        best = std::min(best, along - std::sqrt(w.radius_m * w.radius_m - square));
    }
    return best;
  }

  void control() {
    look();
    while (!on_the_way_.empty() && on_the_way_.front().arrival <= stamp(now_s_)) {
      base_ = on_the_way_.front();
      on_the_way_.pop_front();
    }
    base_.arrival = stamp(now_s_);
    tracker_.update(*scan_, T_base_laser_, base_.odometry);
    found_count_ = tracker_.around(base_.odometry, scan_->first_beam, found_);
    GateInput in;
    in.now = stamp(now_s_);
    in.request = {wanted, true, in.now};
    in.base = &base_;
    in.front_scan = scan_.get();
    in.T_base_laser = T_base_laser_;
    if (!takes_all_for_standing) in.moving = moving();
    in.firmware_watchdog = std::chrono::milliseconds(2000);
    in.limits = limits;
    out_ = gate(gate_, in);
    if (free_of_gate) out_.command.twist = wanted;
    if (free_of_gate) out_.command.estop = false;
  }

  static constexpr double kDelay_s = 0.06;
  struct Past {
    double at_s = 0.0;
    types::Se2 pose;
  };
  struct Sent {
    double at_s = 0.0;
    types::BaseCommand command;
  };
  std::mt19937 random_;
  double now_s_ = 0.0, told_s_ = -1.0;
  types::Se2 reckoned_, T_base_laser_{0.021, 0.0, 0.0};
  std::deque<Past> past_;
  std::deque<Sent> commands_;
  std::deque<types::BaseState> on_the_way_;
  types::BaseState base_;
  std::unique_ptr<types::Scan> scan_ = empty_scan(types::Stamp{});
  perception::MovingObstacles tracker_;
  std::array<perception::MovingObstacle, perception::MovingObstacles::kMax> found_{};
  std::size_t found_count_ = 0;
  GateState gate_;
  GateOutput out_;
};

/// Two legs of a person, side by side.
inline std::vector<Walking> legs(const types::Vector2& at, const types::Vector2& velocity_mps) {
  const types::Vector2 aside = types::Vector2(-velocity_mps.y(), velocity_mps.x()).normalized() * 0.1;
  return {{at + aside, velocity_mps, 0.05, 0.12, 0.0},
          {at - aside, velocity_mps, 0.05, 0.12, std::numbers::pi}};
}

inline std::vector<Wall> box_room(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}}, {{x1, y0}, {x1, y1}}, {{x1, y1}, {x0, y1}}, {{x0, y1}, {x0, y0}}};
}

}  // namespace topo::motion

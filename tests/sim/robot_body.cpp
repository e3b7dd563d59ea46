// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/robot_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace topo::sim {

namespace {

constexpr SimTime kMemory{1'000'000'000};

// A pressed bumper comes free after a few millimetres of way back. Nearer than that a contact goes on: where
// a step is blocked a shorter one may fit (a robot that brakes, a wheel that slips), which is no new
// collision.
constexpr double kBumperTravelM = 0.005;

Prism body_prism(const RobotModel& model, const Polygon& footprint, const Se2& pose) {
  return {transformed(footprint, pose), model.clearance_m, model.height_m};
}

// Motion of the centre between the wheels along an arc.
Se2 arc(double left_m, double right_m, double track_m) {
  const double turn = (right_m - left_m) / track_m;
  const double way = 0.5 * (left_m + right_m);
  // Chord of the arc; near 0, sin(x)/x is 1.
  const double half = 0.5 * turn;
  const double chord = std::abs(half) < 1e-6 ? way : way * std::sin(half) / half;
  return {chord * std::cos(half), chord * std::sin(half), turn};
}

}  // namespace

RobotBody::RobotBody(World& world, RobotModel model, const Se2& start, const Difficulty& difficulty,
                     std::uint64_t seed)
    : world_(world),
      model_(std::move(model)),
      footprint_(model_.footprint()),
      difficulty_(difficulty),
      random_(seed),
      true_track_m_(model_.track_m),
      pose_(start) {
  const auto sign = [this] { return random_.uniform() < 0.5 ? -1.0 : 1.0; };
  scale_left_ = 1.0 + sign() * difficulty_.wheel_scale_error;
  scale_right_ = 1.0 + sign() * difficulty_.wheel_scale_error;
  true_track_m_ = model_.track_m * (1.0 + sign() * difficulty_.track_error);
  movable_ = world_.add_movable(body_prism(model_, footprint_, pose_));
  draw_slip(0.0, false);
  remember();
}

RobotBody::~RobotBody() { world_.remove_movable(movable_); }

void RobotBody::draw_slip(double dt_s, bool driving) {
  if (difficulty_.slip_interval_s <= 0.0) return;
  if (until_slip_s_ <= 0.0 && slip_left_s_ <= 0.0) {
    until_slip_s_ = -difficulty_.slip_interval_s * std::log(1.0 - random_.uniform());
  }
  if (!driving) return;
  if (slip_left_s_ > 0.0) {
    slip_left_s_ -= dt_s;
    if (slip_left_s_ <= 0.0) loss_left_ = loss_right_ = 0.0;
    return;
  }
  until_slip_s_ -= dt_s;
  if (until_slip_s_ > 0.0) return;
  slip_left_s_ = random_.uniform(difficulty_.slip_duration_min_s, difficulty_.slip_duration_max_s);
  const double loss = random_.uniform(difficulty_.slip_loss_min, difficulty_.slip_loss_max);
  const double which = random_.uniform();  // one third each: left, right, both
  loss_left_ = which < 2.0 / 3.0 ? loss : 0.0;
  loss_right_ = which >= 1.0 / 3.0 ? loss : 0.0;
}

bool RobotBody::blocked_at(const Se2& pose) {
  last_touch_ = world_.touch(footprint_, pose, model_.clearance_m, model_.height_m, movable_);
  return last_touch_.touching;
}

void RobotBody::step(double dt_s, double left_mps, double right_mps) {
  const bool driving = left_mps != 0.0 || right_mps != 0.0;
  draw_slip(dt_s, driving);
  now_ += types::from_seconds(dt_s);
  encoder_left_mps_ = left_mps;
  encoder_right_mps_ = right_mps;
  if (driving) {
    const double left_m = left_mps * dt_s * scale_left_ * (1.0 - loss_left_);
    const double right_m = right_mps * dt_s * scale_right_ * (1.0 - loss_right_);
    const double track_m = true_track_m_ / (1.0 - difficulty_.skid);
    const Se2 next = pose_ * arc(left_m, right_m, track_m);
    if (blocked_at(next)) {
      note_contact(last_touch_, left_mps, right_mps);
      encoder_left_mps_ = encoder_right_mps_ = 0.0;
      twist_ = {};
    } else {
      twist_ = {0.5 * (left_m + right_m) / dt_s, (right_m - left_m) / track_m / dt_s};
      path_m_ += std::abs(0.5 * (left_m + right_m));
      pose_ = next;
      leave_contact();
      encoder_left_m_ += left_mps * dt_s;
      encoder_right_m_ += right_mps * dt_s;
      publish();
    }
  } else {
    twist_ = {};
    contact_.stall_left = contact_.stall_right = false;  // bumpers stay pressed until the robot backs off
  }
  remember();
}

void RobotBody::note_contact(const Touch& touch, double left_mps, double right_mps) {
  if (contact_.side == ContactSide::kNone) ++collisions_;
  contact_ = {};
  contact_.at = pose_;
  contact_.point = touch.point;
  contact_.stall_left = left_mps != 0.0;
  contact_.stall_right = right_mps != 0.0;
  // Front or rear when the contact lies beyond three quarters of that length, else left or right.
  const double w = 0.5 * model_.width_m;
  const double x = touch.point.x();
  const double y = touch.point.y();
  const double ahead = x / (x > 0.0 ? model_.length_front_m : model_.length_rear_m);
  const double aside = y / w;
  const double reach =
      std::clamp((x > 0.0 ? -1.0 : 1.0) * y / w, -1.0, 1.0);  // -1..1, clockwise along the end
  const int segment =
      std::min(model_.bumper_segments - 1, static_cast<int>((reach + 1.0) * 0.5 * model_.bumper_segments));
  const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(segment));
  if (std::abs(ahead) >= 0.75) {
    contact_.side = x > 0.0 ? ContactSide::kFront : ContactSide::kRear;
    (x > 0.0 ? contact_.bumpers_front : contact_.bumpers_rear) = bit;
  } else {
    contact_.side = aside > 0.0 ? ContactSide::kLeft : ContactSide::kRight;
  }
}

void RobotBody::leave_contact() {
  contact_.stall_left = contact_.stall_right = false;
  const Se2 moved = contact_.at.inverse() * pose_;
  const double turned_m = std::abs(moved.theta_rad) * std::hypot(contact_.point.x(), contact_.point.y());
  if (std::hypot(moved.x_m, moved.y_m) + turned_m > kBumperTravelM) contact_ = {};
}

void RobotBody::remember() {
  past_.push_back({now_, pose_});
  while (past_.size() > 2 && past_[1].time < now_ - kMemory) past_.pop_front();
}

void RobotBody::publish() { world_.move_movable(movable_, body_prism(model_, footprint_, pose_)); }

Se2 RobotBody::pose_at(SimTime time) const {
  if (time <= past_.front().time) return past_.front().pose;
  if (time >= past_.back().time) return past_.back().pose;
  const auto after =
      std::lower_bound(past_.begin(), past_.end(), time, [](const Past& p, SimTime t) { return p.time < t; });
  const auto before = after - 1;
  const double part = static_cast<double>((time - before->time).count()) /
                      static_cast<double>((after->time - before->time).count());
  return types::interpolate(before->pose, after->pose, part);
}

void RobotBody::start_clock(SimTime now) {
  now_ = now;
  past_.clear();
  remember();
}

void RobotBody::teleport(const Se2& pose) {
  pose_ = pose;
  contact_ = {};
  past_.clear();
  remember();
  publish();
}

}  // namespace topo::sim

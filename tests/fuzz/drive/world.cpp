// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/drive/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "core/types/robot_limits.hpp"
#include "tests/sim/devices/arcos_packet.hpp"

namespace topo::fuzz {
namespace {

using types::Vector2;

constexpr types::Duration kStep = std::chrono::milliseconds(5);
constexpr double kLaserAhead_m = 0.021, kRange_m = 5.5;
constexpr double kTrack_m = 0.325;
constexpr std::uint32_t kNoReturn = 0, kTooNear_mm = 30;  // PROTOCOLS section 10.2, URG-04LX

sim::ScipOptions scanner_options() {
  sim::ScipOptions options;
  options.model = sim::ScipModel::kUrg04Lx;
  return options;
}

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Points of the hull's outline, in base.
std::array<Vector2, 48> outline() {
  std::array<Vector2, 48> points;
  const types::ModelSize& size = types::kP3dx;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(points.size());
    const double c = std::cos(angle), s = std::sin(angle);
    const double along = c > 0.0 ? size.front_m / c : size.rear_m / std::max(-c, 1e-9);
    const double r = std::min({along, size.width_m / 2.0 / std::max(std::abs(s), 1e-9), size.swing_radius_m});
    points[i] = {r * c, r * s};
  }
  return points;
}

/// Noise of a few millimetres, without which a picture would count as frozen.
int noise_mm(std::uint32_t picture, std::uint32_t beam) {
  const std::uint32_t hash = (picture * 2654435761U) ^ (beam * 40503U);
  return static_cast<int>((hash >> 7U) % 9U) - 4;
}

/// Distance along a ray to a segment of an axis-parallel line at `offset`, of which the ray is at `across`.
void nearer(double offset, double speed, double across, double across_speed, double low, double high,
            double& best_m) {
  if (std::abs(speed) < 1e-9) return;
  const double t = offset / speed;
  if (t <= 0.0 || t >= best_m) return;
  const double hit = across + t * across_speed;
  if (hit >= low && hit <= high) best_m = t;
}

}  // namespace

World::World(types::Stamp begin)
    : now_(begin), base_(sim::arcos::p3dx_parameters(), 1), scanner_(scanner_options()), next_turn_(begin) {
  turn_.beams.resize(static_cast<std::size_t>(scanner_.model().beams()));
}

void World::advance(types::Stamp until) {
  while (now_ + kStep <= until) {
    now_ += kStep;
    step();
  }
}

void World::step() {
  deliver_commands();
  drive(types::to_seconds(kStep));
  if (now_ >= next_turn_) look();
  scanner_.tick(sim_now());
  pump();
}

void World::drive(double dt_s) {
  const auto wheels = base_.control(sim_now(), kStep, inputs_);
  const double v = (wheels.left_mps + wheels.right_mps) / 2.0;
  const double omega = (wheels.right_mps - wheels.left_mps) / kTrack_m;
  const types::Se2 next = pose_ * types::Se2{v * dt_s, 0.0, omega * dt_s};
  inputs_.left_mps = wheels.left_mps;
  inputs_.right_mps = wheels.right_mps;
  if (touches(next, now_)) {
    constexpr double kDriven_mps = 0.03;
    if (v > kDriven_mps && v_mps_ > kDriven_mps) ++collisions_;
    inputs_.left_mps = inputs_.right_mps = v_mps_ = 0.0;
    return;
  }
  pose_ = next;
  v_mps_ = v;
  inputs_.left_m += wheels.left_mps * dt_s;
  inputs_.right_m += wheels.right_mps * dt_s;
}

bool World::touches(const types::Se2& pose, types::Stamp since) const {
  static const std::array<Vector2, 48> kOutline = outline();
  return std::any_of(kOutline.begin(), kOutline.end(), [&](const Vector2& point) {
    const Vector2 p = pose * point;
    if (std::abs(p.y()) > kHalfWidth_m) return true;
    return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
      return box.since <= since && std::abs(p.x() - box.centre.x()) < Box::kHalf_m &&
             std::abs(p.y() - box.centre.y()) < Box::kHalf_m;
    });
  });
}

void World::add_box(double more_m) {
  constexpr std::size_t kMost = 4;
  // With the firmware's watchdog of 2 s and its braking; the rest is the age of the data and the period.
  constexpr double kBlind_s = 2.8, kBraking_mps2 = 0.3, kAlways_m = 0.2;
  const double v = std::max(v_mps_, 0.0);
  const double ahead_m = types::kP3dx.front_m + kAlways_m + v * kBlind_s + v * v / (2.0 * kBraking_mps2) +
                         more_m + Box::kHalf_m * std::numbers::sqrt2;
  if (boxes_.size() == kMost) boxes_.erase(boxes_.begin());
  boxes_.push_back({pose_ * Vector2{ahead_m, 0.0}, now_});
}

double World::ray_m(const Vector2& from, double heading_rad) const {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  double best_m = 1e3;
  for (const double side : {-kHalfWidth_m, kHalfWidth_m})
    nearer(side - from.y(), s, from.x(), c, -1e6, 1e6, best_m);
  for (const Box& box : boxes_) {
    for (const double half : {-Box::kHalf_m, Box::kHalf_m}) {
      nearer(box.centre.y() + half - from.y(), s, from.x(), c, box.centre.x() - Box::kHalf_m,
             box.centre.x() + Box::kHalf_m, best_m);
      nearer(box.centre.x() + half - from.x(), c, from.y(), s, box.centre.y() - Box::kHalf_m,
             box.centre.y() + Box::kHalf_m, best_m);
    }
  }
  return best_m;
}

void World::picture(sim::scip::Turn& turn) {
  const sim::ScipModelSpec& model = scanner_.model();
  const Vector2 eye = pose_ * Vector2{kLaserAhead_m, 0.0};
  ++pictures_;
  for (std::size_t i = 0; i < turn.beams.size(); ++i) {
    const double angle =
        (model.amin + static_cast<int>(i) - model.afrt) * 2.0 * std::numbers::pi / model.ares;
    const double range_m = ray_m(eye, pose_.theta_rad + angle);
    const int mm = static_cast<int>(range_m * 1e3) + noise_mm(pictures_, static_cast<std::uint32_t>(i));
    std::uint32_t told = range_m < kRange_m ? static_cast<std::uint32_t>(std::max(mm, 20)) : kNoReturn;
    if (lies.blind) told = kNoReturn;
    if (lies.covered && angle > 0.0 && angle < std::numbers::pi / 2.0) told = kTooNear_mm;
    turn.beams[i].echoes[0] = {told, 0};
  }
}

void World::look() {
  const sim::SimTime period = scanner_.model().period();
  turn_.step0 = sim_now() - period;
  if (!lies.frozen) picture(turn_);
  scanner_.deliver(turn_, sim_now());
  next_turn_ += period;
}

void World::pump() {
  constexpr std::size_t kWhole = 1U << 20U, kScanBytes = 500, kType = 3;
  for (std::string_view m = scanner_.output().peek(sim_now(), kWhole); !m.empty();
       m = scanner_.output().peek(sim_now(), kWhole)) {
    const bool scan = m.size() > kScanBytes;
    scan_line.send(m, now_, {scan && lies.of_scanner() == 0, scan ? lies.of_scanner() : 0U});
    scanner_.output().consume(m.size());
  }
  for (std::string_view m = base_.output().peek(sim_now(), kWhole); !m.empty();
       m = base_.output().peek(sim_now(), kWhole)) {
    const bool status = m.size() > kType && (m[kType] == 0x32 || m[kType] == 0x33);
    base_line.send(m, now_, {status, 0});
    base_.output().consume(m.size());
  }
}

void World::to_base(std::string_view bytes) {
  base_bytes_ += bytes.size();
  if (command_faults.lost) return;
  const types::Stamp before = commands_.empty() ? now_ : commands_.back().due;
  commands_.push_back({std::max(now_ + command_faults.delay, before), std::string(bytes)});
  deliver_commands();
}

void World::deliver_commands() {
  static const std::string kPulse = sim::arcos::PacketBuilder(0).frame();
  for (; !commands_.empty() && commands_.front().due <= now_; commands_.pop_front()) {
    const bool swallowed = lies.deaf && base_.state() == sim::ArcosDevice::State::kOpen;
    if (swallowed) swallowed_ = now_;
    base_.receive(bytes_of(swallowed ? std::string_view(kPulse) : std::string_view(commands_.front().bytes)),
                  sim_now());
  }
}

void World::to_scanner(std::string_view bytes) {
  scanner_.receive(bytes_of(bytes), sim_now());
  pump();
}

}  // namespace topo::fuzz

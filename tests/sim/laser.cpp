// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/laser.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace topo::sim {

namespace {

LaserModel utm_family(std::string name, int distance_min_mm, int distance_max_mm, double range_max_m,
                      std::uint32_t code_no_return) {
  return {std::move(name), 1440, 0,           1080,           540, distance_min_mm,
          distance_max_mm, 2400, range_max_m, code_no_return, 2,   3};
}

// Decreases with distance and angle of incidence; plausible, but not the curve of a real sensor.
std::uint16_t intensity_of(const RayHit& hit) {
  const double albedo = hit.surface == Surface::kGlass ? 300.0 : 4000.0;
  return static_cast<std::uint16_t>(
      albedo * (0.2 + 0.8 * hit.cos_incidence) / (1.0 + 0.02 * hit.range_m * hit.range_m) + 100.0);
}

}  // namespace

LaserModel LaserModel::utm_30lx() { return utm_family("UTM-30LX", 23, 60000, 30.0, 1); }
LaserModel LaserModel::utm_30lx_ew() { return utm_family("UTM-30LX-EW", 23, 60000, 30.0, 65533); }
LaserModel LaserModel::ust_10lx() { return utm_family("UST-10LX", 20, 30000, 10.0, 65533); }
LaserModel LaserModel::ust_20lx() { return utm_family("UST-20LX", 20, 60000, 20.0, 65533); }
LaserModel LaserModel::urg_04lx() { return {"URG-04LX", 1024, 44, 725, 384, 20, 5600, 600, 5.6, 0, 6, 19}; }

double LaserModel::angle_rad(int step) const {
  return (step - step_front) * (2.0 * std::numbers::pi / steps_per_turn);
}

LaserSimulator::LaserSimulator(const World& world, LaserModel model, LaserMount mount,
                               const Difficulty& difficulty, std::uint64_t seed, MovableId self)
    : world_(world),
      model_(std::move(model)),
      mount_(mount),
      difficulty_(difficulty),
      seed_(seed),
      self_(self),
      hits_(static_cast<std::size_t>(model_.steps())),
      ranges_m_(hits_.size()) {}

Ray LaserSimulator::beam(int step, const Se2& pose) const {
  const Vector2 origin = pose * Vector2(mount_.x_m, mount_.y_m);
  const double side = mount_.mirrored ? -1.0 : 1.0;
  const double angle = model_.angle_rad(step);
  const double yaw = pose.theta_rad + mount_.yaw_rad;
  if (mount_.plane == ScanPlane::kLevel) {
    return {origin.x(), origin.y(), mount_.z_m, std::cos(yaw + side * angle), std::sin(yaw + side * angle),
            0.0};
  }
  const double rolled = angle + mount_.roll_rad;
  const double left = side * std::sin(rolled);
  return {origin.x(), origin.y(), mount_.z_m, -std::sin(yaw) * left, std::cos(yaw) * left, std::cos(rolled)};
}

void LaserSimulator::cast_all(SimTime step0, const PoseAt& pose_at, Random& random) {
  RayOptions options;
  options.range_max_m = model_.range_max_m;
  options.exclude = self_;
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const int step = model_.step_min + static_cast<int>(i);
    options.glass_draw = difficulty_.glass_transparent ? random.uniform() : 1.0;
    hits_[i] = world_.cast(beam(step, pose_at(step0 + model_.step_time(step))), options);
    ranges_m_[i] = hits_[i].range_m;
  }
}

// A beam that hits an edge partly reports a range between the two depths.
void LaserSimulator::mix_pixels(Random& random) {
  if (difficulty_.mixed_pixel_probability <= 0.0) return;
  for (std::size_t i = 0; i + 1 < hits_.size(); ++i) {
    const double a = std::min(hits_[i].range_m, model_.range_max_m);
    const double b = std::min(hits_[i + 1].range_m, model_.range_max_m);
    if (std::abs(a - b) < difficulty_.mixed_pixel_step_m) continue;
    if (random.uniform() >= difficulty_.mixed_pixel_probability) continue;
    const std::size_t which = random.uniform() < 0.5 ? i : i + 1;
    ranges_m_[which] = random.uniform(std::min(a, b), std::max(a, b));
  }
}

std::uint32_t LaserSimulator::reading(double true_range_m, Random& random) const {
  // The number of draws per beam is constant, so that one reading does not shift the noise of the next.
  const double dropout = random.uniform();
  const double noise = random.gaussian();
  if (dropout < difficulty_.dropout_probability) {
    return dropout < 0.5 * difficulty_.dropout_probability ? model_.code_no_return : model_.code_failed;
  }
  if (!(true_range_m < model_.range_max_m)) return model_.code_no_return;
  const double sigma = true_range_m <= difficulty_.range_sigma_split_m ? difficulty_.range_sigma_near_m
                                                                       : difficulty_.range_sigma_far_m;
  const double mm = std::round(1e3 * (true_range_m + sigma * noise));
  if (mm < model_.distance_min_mm) return model_.code_too_near;
  return mm > model_.distance_max_mm ? model_.code_no_return : static_cast<std::uint32_t>(mm);
}

void LaserSimulator::measure(SimTime step0, std::uint64_t number, const PoseAt& pose_at, Sweep& out) {
  Random random(derive_seed(seed_, number));
  cast_all(step0, pose_at, random);
  mix_pixels(random);
  out.step0 = step0;
  out.end = step0 + model_.step_time(model_.step_max);
  out.number = number;
  out.step_min = model_.step_min;
  out.range_mm.resize(hits_.size());
  out.intensity.resize(hits_.size());
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const std::uint32_t mm = reading(ranges_m_[i], random);
    const bool seen = mm >= static_cast<std::uint32_t>(model_.distance_min_mm) &&
                      mm <= static_cast<std::uint32_t>(model_.distance_max_mm);
    out.range_mm[i] = mm;
    out.intensity[i] = seen ? intensity_of(hits_[i]) : std::uint16_t{0};
  }
}

Sweep LaserSimulator::measure(SimTime step0, std::uint64_t number, const PoseAt& pose_at) {
  Sweep sweep;
  measure(step0, number, pose_at, sweep);
  return sweep;
}

}  // namespace topo::sim

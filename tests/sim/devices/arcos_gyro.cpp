// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/arcos_gyro.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/types/se2.hpp"

namespace topo::sim::arcos {
namespace {

constexpr SimTime kPeriod = std::chrono::milliseconds(25);
constexpr double kUnitsPerDegps = 1.0485;  ///< ARIA's GyroScaler 1.626 of 5 V / 1023 and 120 degrees/s a volt
constexpr double kRest_units = 6.0;        ///< at most beside 512,
constexpr double kDrift_units_per_s = 0.005;  ///< and as it warms up
constexpr double kNoise_units = 0.7;
constexpr double kScaleError = 0.01;  ///< of one gyro against another
constexpr std::size_t kMost = 40;     ///< a second of readings that nobody took
constexpr int kMiddle = 512, kTop = 1023;

}  // namespace

AnalogGyro::AnalogGyro(std::uint64_t seed) : random_(seed) {
  std::uniform_real_distribution<> either(-1.0, 1.0);
  rest_units_ = kRest_units * either(random_);
  drift_units_per_s_ = kDrift_units_per_s * either(random_);
  scale_ = kUnitsPerDegps * (1.0 + kScaleError * either(random_));
}

void AnalogGyro::feel(SimTime now, double omega_radps) {
  if (next_ == SimTime{0}) next_ = now;
  std::normal_distribution<> noise(0.0, kNoise_units);
  for (; next_ <= now; next_ += kPeriod) {
    const double rest = kMiddle + rest_units_ + drift_units_per_s_ * seconds_of(next_);
    const double units = rest - scale_ * omega_radps / types::kDegree_rad + noise(random_);
    if (readings_.size() < kMost)
      readings_.push_back(static_cast<int>(std::clamp(std::lround(units), 0L, static_cast<long>(kTop))));
  }
}

std::vector<int> AnalogGyro::take() { return std::exchange(readings_, {}); }

}  // namespace topo::sim::arcos

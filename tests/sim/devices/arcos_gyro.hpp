// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "tests/sim/devices/sim_time.hpp"

namespace topo::sim::arcos {

/// The analog gyro of a P3-AT: a reading every 25 ms, of 10 bits (PROTOCOLS section 5). At rest it reads
/// somewhat beside 512, and that drifts.
class AnalogGyro {
 public:
  explicit AnalogGyro(std::uint64_t seed);

  /// The true turning speed, counter-clockwise, since the last call.
  void feel(SimTime now, double omega_radps);
  /// The readings since the last call.
  [[nodiscard]] std::vector<int> take();

 private:
  std::mt19937_64 random_;
  double rest_units_;
  double drift_units_per_s_;
  double scale_;
  SimTime next_{0};
  std::vector<int> readings_;
};

}  // namespace topo::sim::arcos

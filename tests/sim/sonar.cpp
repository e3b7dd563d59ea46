// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/sonar.hpp"

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"

namespace topo::sim {

namespace {

constexpr double kHalfCone_rad = 12.5 * types::kDegree_rad;
constexpr int kAcross = 2;               // rays to each side of the axis
constexpr double kSpecularCosine = 0.5;  // more than 60 degrees off the normal the echo is lost

}  // namespace

SonarEcho measure_sonar(const World& world, const RobotModel& model, const Se2& pose, int index, SimTime time,
                        const Difficulty& difficulty, Random& random, MovableId self) {
  const SonarMount& mount = model.sonars.at(static_cast<std::size_t>(index));
  const Vector2 origin = pose * Vector2(mount.x_m, mount.y_m);
  RayOptions options;
  options.range_max_m = kSonarRangeMax_m;
  options.exclude = self;
  double nearest_m = kSonarRangeMax_m;
  for (int up = -kAcross; up <= kAcross; ++up) {
    for (int side = -kAcross; side <= kAcross; ++side) {
      const double yaw = pose.theta_rad + mount.heading_rad + kHalfCone_rad * side / kAcross;
      const double pitch = kHalfCone_rad * up / kAcross;
      const RayHit hit = world.cast({origin.x(), origin.y(), model.sonar_z_m, std::cos(yaw) * std::cos(pitch),
                                     std::sin(yaw) * std::cos(pitch), std::sin(pitch)},
                                    options);
      if (hit.surface != Surface::kNone && hit.cos_incidence >= kSpecularCosine)
        nearest_m = std::min(nearest_m, hit.range_m);
    }
  }
  const bool lost = random.uniform() < difficulty.sonar_dropout_probability;
  const double noisy_m = nearest_m * (1.0 + difficulty.sonar_relative_sigma * random.gaussian());
  const double range_m = lost || nearest_m >= kSonarRangeMax_m ? kSonarRangeMax_m : noisy_m;
  return {time, index, std::clamp(range_m, kSonarRangeMin_m, kSonarRangeMax_m)};
}

}  // namespace topo::sim

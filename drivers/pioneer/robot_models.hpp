// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/types/robot_limits.hpp"
#include "core/types/se2.hpp"

namespace topo::pioneer {

/// Properties of a robot that the protocol does not transmit (PROTOCOLS section 6). Lengths from the centre
/// of rotation.
struct RobotModel {
  static constexpr std::size_t kSonars = 16;

  std::string_view subclass;
  double mm_per_count = 1.0;            ///< DistConvFactor
  double mmps_per_velocity_unit = 1.0;  ///< VelConvFactor
  double mm_per_sonar_unit = 1.0;       ///< RangeConvFactor
  double radps_per_mmps = 0.0056;       ///< DiffConvFactor, per half the difference of the wheels' speeds
  types::ModelSize size;
  std::array<types::Se2, kSonars> T_base_sonar;
};

/// THPOS unit. ARIA's rounded 0.00153 is 0.26 % too small (PROTOCOLS section 6.1).
inline constexpr int kHeadingUnits = 4096;
double radians_per_heading_unit();

/// No echo is received from beyond this range (PROTOCOLS section 6.3).
inline constexpr double kSonarRangeMax_m = 5.0;

/// Null for a subclass without a table. The comparison ignores case.
const RobotModel* find_model(std::string_view subclass);

/// "p3dx-sh, p3at-sh, ...", for messages.
std::string known_subclasses();

}  // namespace topo::pioneer

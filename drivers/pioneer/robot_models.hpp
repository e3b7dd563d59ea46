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

  std::string_view subclass;  ///< that names the family: "p3dx-sh"
  std::string_view chassis;   ///< "p3dx" or "p3at": whose hull, top speeds and sonar poses these are
  double mm_per_count = 1.0;  ///< DistConvFactor
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

/// Null for a subclass that names no family itself. The comparison ignores case.
const RobotModel* find_model(std::string_view subclass);

/// The family of a subclass as controllers tell it: the one that it names, or that of its board with the
/// name of what is mounted behind it ("p3dx-sh-lms1xx": an SH-2 board, whose factors do not depend on the
/// laser). Null where the board is not told, as in "p3dx-lms200": the factors of the boards differ twofold.
const RobotModel* find_family(std::string_view subclass);

/// Empty when `subclass` is that of a robot whose table is its own; otherwise what is taken for granted of
/// it, with the numbers.
std::string assumption(std::string_view subclass, const RobotModel& family);

/// "p3dx-sh, p3at-sh, ...", for messages.
std::string known_families();

}  // namespace topo::pioneer

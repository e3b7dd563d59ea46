// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/types/base_state.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::perception {

/// Beams within this angle of the robot's x axis are the forward sector.
inline constexpr double kForwardSector_rad = 1.0471975511965976;  // 60 degrees

/// What a beam, or a gap between beams, is taken for.
struct ScanPoint {
  types::Vector2 p_base{0.0, 0.0};
  bool forward = false;     ///< of the forward sector
  bool remembered = false;  ///< out of the scanner's view now (BlindSpot)
};

/// What stands around, from the newest raw data. Pointers and spans are borrowed for the call.
struct Surroundings {
  const types::Scan* front_scan = nullptr;
  types::Se2 T_base_laser;
  /// scan_points() of front_scan and T_base_laser, for those who ask several times; empty: the scan is
  /// walked.
  std::span<const ScanPoint> points{};
  std::span<const types::SonarReading> sonar;
  std::span<const types::Se2> T_base_sonar;  ///< as many as are known; readings without a pose are ignored
  double sonar_range_max_m = 5.0;
  types::Stamp now{};
  /// The robot moves backwards out of a touch: what a front bumper or a beam has within the outline's front
  /// half is left behind and does not count.
  bool backing_off = false;
};

/// Part of the forward sector's beams that measured something or saw nothing within range; 0 for a scan
/// without a beam there. Below a half the scan counts as stale (DESIGN "Motion and safety").
double forward_valid_fraction(const types::Scan& scan, const types::Se2& T_base_laser);

/// The obstacles of a scan as free_time_s() takes them, the robot's own outline not yet left out. `out` has
/// room for a point for each beam. Returns how many were written; one walk over the scan.
std::size_t scan_points(const types::Scan& scan, const types::Se2& T_base_laser, std::span<ScanPoint> out);

/// How long the robot can go on at `twist` until its footprint with the margin meets something. Zero for a
/// twist that is not finite, kNever_s when nothing is in the way.
///
/// Beams of the forward sector that are too near are obstacles at the sensor's least range, and so are gaps
/// of invalid beams. A gap of up to three beams (13 mm wide at 1 m with 0.25 degrees) takes the nearer
/// neighbour's range instead: lone dropouts are everyday and would stop the robot at every scan.
///
/// A single beam that hangs in the air beyond 0.7 m, both neighbours more than 0.15 m away from it, is a
/// mixed pixel at an edge and does not count: at 0.7 m anything of 1 cm is hit by three beams.
double free_time_s(const types::Twist2& twist, const types::RobotLimits& limits, const Surroundings& around);

/// The same without margin for the two arcs on which a slipping wheel may take a robot that drives forwards
/// (limits.slip_curvature_per_m); kNever_s otherwise.
double slip_free_time_s(const types::Twist2& twist, const types::RobotLimits& limits,
                        const Surroundings& around);

/// Whether a twist counts as a turn on the spot, which keeps turn_margin_m only.
bool is_on_the_spot(const types::Twist2& twist);

/// Distance from the outline as it stands to the nearest of the points that are only remembered, metres;
/// `far_m` when there is none as near.
double remembered_gap_m(const types::RobotLimits& limits, const Surroundings& around, double far_m);

/// The obstacles as free_time_s() takes them, in base, within `reach_m` of the robot's centre and thinned to
/// about `spacing_m`, for those who look for a way. Returns how many were written to `out`.
std::size_t collect_obstacles(const types::RobotLimits& limits, const Surroundings& around, double reach_m,
                              double spacing_m, std::span<types::Vector2> out);

/// The same as a length on the path of the robot's centre; for a turn on the spot there is none: kNever_s or
/// 0.
double free_distance_m(const types::Twist2& twist, double free_time_s);

}  // namespace topo::perception

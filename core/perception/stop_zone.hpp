// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/perception/params.hpp"
#include "core/types/base_state.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::perception {

/// Obstacle point of a beam, or of a gap between beams.
struct ScanPoint {
  types::Vector2 p_base{0.0, 0.0};
  bool forward = false;     ///< within StopZoneParams::forward_sector_rad of the robot's x axis
  bool remembered = false;  ///< currently out of the scanner's view (BlindSpot)
};

/// Obstacles around the robot, from the newest raw data. Pointers and spans are borrowed for the call.
struct Surroundings {
  const types::Scan* front_scan = nullptr;
  types::Se2 T_base_laser;
  /// scan_points() of front_scan and T_base_laser, for callers with several queries; empty: the scan is
  /// walked.
  std::span<const ScanPoint> points{};
  std::span<const types::SonarReading> sonar;
  std::span<const types::Se2> T_base_sonar;  ///< as many as are known; readings without a pose are ignored
  double sonar_range_max_m = 5.0;
  types::Stamp now{};
  /// The robot backs off from a touch: points of the scan and the sonar in the front half of the outline are
  /// left behind and do not count.
  bool backing_off = false;
  StopZoneParams params{};
};

/// Fraction, 0 to 1, of the beams that the forward sector should have at the scan's angle increment which
/// measured a distance or nothing within range. A direction without a beam counts as not seen, so that a
/// scanner that does not look ahead is blind; 0 for an increment or a mount that is not finite. Below one
/// half the gate stops the robot (DESIGN "Motion and safety").
double forward_valid_fraction(const types::Scan& scan, const types::Se2& T_base_laser,
                              const StopZoneParams& params);

/// Writes the obstacle points of a scan as free_time_s() uses them, still including the robot's own outline.
/// `out` has space for one point per beam. Returns how many were written. One pass over the scan.
std::size_t scan_points(const types::Scan& scan, const types::Se2& T_base_laser, const StopZoneParams& params,
                        std::span<ScanPoint> out);

/// Seconds for which the robot can continue at `twist` until its footprint with the margin meets an obstacle.
/// Zero for a twist that is not finite, kNever_s when nothing is in the way.
///
/// Beams of the forward sector that are too near are obstacles at the sensor's minimum range, and so are gaps
/// of invalid beams. A gap of up to StopZoneParams::bridged_beams takes the nearer neighbour's range instead:
/// single dropouts are common and would stop the robot at every scan.
///
/// An isolated hit, with both neighbours at another distance (MixedPixelParams), is a mixed pixel at an edge
/// and does not count.
double free_time_s(const types::Twist2& twist, const types::RobotLimits& limits, const Surroundings& around);

/// The same without margin for the two arcs to which a slipping wheel may lead while the robot drives
/// forwards (limits.slip_curvature_per_m); kNever_s otherwise.
double slip_free_time_s(const types::Twist2& twist, const types::RobotLimits& limits,
                        const Surroundings& around);

/// True when a twist counts as a turn on the spot, which keeps turn_margin_m only.
bool is_on_the_spot(const types::Twist2& twist, const StopZoneParams& params);

/// Distance from the current outline to the nearest point that is only remembered, metres; `far_m` when none
/// is nearer.
double remembered_gap_m(const types::RobotLimits& limits, const Surroundings& around, double far_m);

/// Writes the obstacle points as free_time_s() uses them, in base, within `reach_m` of the robot's centre and
/// thinned to about `spacing_m`, for path following. Returns how many were written to `out`.
std::size_t collect_obstacles(const types::RobotLimits& limits, const Surroundings& around, double reach_m,
                              double spacing_m, std::span<types::Vector2> out);

/// A free time as a distance along the path of the robot's centre. A pure rotation has none: kNever_s, or 0
/// when the time is 0.
double free_distance_m(const types::Twist2& twist, double free_time_s);

}  // namespace topo::perception

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/types/result.hpp"
#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/carmen/fields.hpp"

namespace topo::bench {

/// What the PARAM lines of a log say of one scanner.
struct ScannerFacts {
  std::optional<double> step_deg;  ///< laser_front_laser_resolution
  std::optional<double> view_deg;  ///< laser_front_laser_fov
  std::optional<double> reach_m;   ///< robot_front_laser_max
  std::optional<double> ahead_m;   ///< robot_frontlaser_offset: place before the robot's centre
  std::optional<double> left_m;    ///< robot_frontlaser_side_offset
  std::optional<double> turn_rad;  ///< robot_frontlaser_angular_offset

  [[nodiscard]] bool says_place() const { return ahead_m || left_m || turn_rad; }
  [[nodiscard]] types::Se2 T_robot_laser() const;
};

/// Of both scanners that CARMEN knows by such names.
struct LogFacts {
  ScannerFacts front, rear;
  /// Takes what a PARAM line says of a scanner; a value that is no sensible number says nothing.
  void take(const Fields& f);
};

/// Angles of a sweep whose message does not state them: the option's, else what the log's PARAM lines say,
/// else those of the scanners of the time, which differ in their numbers of beams. Nothing when none has this
/// number.
std::optional<BeamAngles> angles_of(std::size_t beams, const ScannerFacts& facts, const LogOptions& options);

/// Those of the scanner that has this number of beams.
std::optional<BeamAngles> usual_angles(std::size_t beams);

/// "180, 181, 360, ...", for messages.
std::string known_beam_counts();

}  // namespace topo::bench

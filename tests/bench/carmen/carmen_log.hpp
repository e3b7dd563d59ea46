// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "core/types/se2.hpp"

namespace topo::bench {

/// One sweep of a log. Stamps are the log's own (ipc_ts), in seconds.
struct CarmenScan {
  double stamp_s = 0.0;        ///< end of the sweep: not before its last beam
  std::vector<float> range_m;  ///< distance, types::kNoReturn at or beyond range_max_m, types::kInvalid for a
                               ///< failed reading
  float angle_min_rad = 0.0F;  ///< of beam 0, counter-clockwise
  float angle_increment_rad = 0.0F;
  float time_increment_s = 0.0F;  ///< between neighbouring beams; 0 when the sweep is fast enough to be
                                  ///< neglected (SICK, 7 ms)
  float range_max_m = 0.0F;
  types::Se2 laser_odom;  ///< pose of the laser by dead reckoning
  types::Se2 robot_odom;  ///< pose of the robot's centre by dead reckoning
};

struct CarmenOdometry {
  double stamp_s = 0.0;
  types::Se2 pose;
  double v_mps = 0.0;
  double omega_radps = 0.0;
};

/// A robot's log in memory, in the order of its stamps (lines with one stamp keep the file's order).
struct CarmenLog {
  std::vector<CarmenScan> scans;
  std::vector<CarmenOdometry> odometry;  ///< empty when the log has odometry in its scans only
  int stamp_inversions = 0;              ///< scans in the file with a stamp before that of the previous scan
  int odometry_inversions = 0;           ///< likewise for odometry
  int other_lines = 0;                   ///< messages without scans or odometry
  int foreign_lines = 0;                 ///< lines that are no messages of CARMEN
  /// Readings from here on have no return, where the messages do not say so (range_limit.hpp); 0: no limit
  /// found
  double range_limit_m = 0.0;
  std::size_t readings_beyond = 0;  ///< number of those readings
  int scans_ignored = 0;            ///< of another message than the one that was taken
  std::vector<std::string>
      remarks;  ///< what was passed over or taken otherwise than assumed, a sentence each
};

/// Directions of the beams of one sweep, relative to the scanner.
struct BeamAngles {
  double first_rad = 0.0;
  double step_rad = 0.0;  ///< counter-clockwise
};

/// What the file does not say.
struct LogOptions {
  std::optional<BeamAngles> beams;  ///< of messages that do not state their angles, whatever their number is
  double odometry_gap_max_s =
      1.0;  ///< a scan without a pose takes it from odometry on both sides, no further apart;
            ///< within it a Pioneer of 0.7 m/s2 departs by 0.1 m from the mean motion
};

/// Reads a CARMEN log (.clf, .clf.gz, .clf.bz2). Scans are those of one message, the first that the file has
/// of ROBOTLASER1, FLASER, ROBOTLASER0, 2..9, RLASER, RAWLASER1..9; the last takes its poses from ODOM.
/// FLASER and RLASER say nothing of the scanner: its angles, reach and place are those of the log's PARAM
/// lines, else of the scanner that has this number of beams (scanner_facts.hpp), and readings that accumulate
/// at the longest range count as no return (piled_up_range_m). Lines that are no messages, and a last line
/// without end that is no whole message, are passed over with a remark. Errors give the file, the line, the
/// value found and the expected form: kNotFound, kPermission, kIo; kInvalidInput for damaged or truncated
/// packing, a wrong count, an invalid number, a missing stamp, a number of beams that no known scanner has,
/// and a log without a scan.
types::Result<CarmenLog> read_carmen_log(const std::string& path, const LogOptions& options = {});

/// Reads a log of the Mines robot (Hokuyo URG-04LX and wheel encoders; columns as in tinySLAM's test data)
/// into the same form. The odometry is integrated from the encoders, starting at the origin. Errors as above.
types::Result<CarmenLog> read_mines_log(const std::string& path);

}  // namespace topo::bench

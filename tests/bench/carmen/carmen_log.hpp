// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  double range_limit_m =
      0.0;  ///< FLASER readings from here on have no return (range_limit.hpp); 0: no limit found
  std::size_t readings_beyond = 0;  ///< number of those readings
  int flaser_ignored = 0;           ///< FLASER lines in a log that also has the more detailed ROBOTLASER1
};

/// Reads a CARMEN log (.clf, .clf.gz, .clf.bz2): FLASER, ROBOTLASER1 and ODOM; other messages are counted.
/// FLASER readings that accumulate at the log's longest range count as no return (piled_up_range_m). Errors
/// give the file, the line, the value found and the expected form: kNotFound, kPermission, kIo; kInvalidInput
/// for damaged or truncated input, a wrong count, an invalid number, a missing stamp, and a log without a
/// scan.
types::Result<CarmenLog> read_carmen_log(const std::string& path);

/// Reads a log of the Mines robot (Hokuyo URG-04LX and wheel encoders; columns as in tinySLAM's test data)
/// into the same form. The odometry is integrated from the encoders, starting at the origin. Errors as above.
types::Result<CarmenLog> read_mines_log(const std::string& path);

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "core/types/se2.hpp"

namespace topo::daemon {

/// One sweep of a log. Stamps are the log's own (ipc_ts), in seconds.
struct CarmenScan {
  double stamp_s = 0.0;        ///< when the sweep was in: not before its last beam
  std::vector<float> range_m;  ///< distance, types::kNoReturn at or beyond range_max_m, types::kInvalid where
                               ///< the sensor failed
  float angle_min_rad = 0.0F;  ///< of beam 0, counter-clockwise
  float angle_increment_rad = 0.0F;
  float time_increment_s = 0.0F;  ///< between neighbouring beams; 0 where the log's sensor sweeps too fast to
                                  ///< matter (SICK, 7 ms)
  float range_max_m = 0.0F;
  types::Se2 laser_odom;  ///< pose of the laser as dead reckoning has it
  types::Se2 robot_odom;  ///< pose of the robot's centre, likewise
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
  std::vector<CarmenOdometry> odometry;  ///< empty where the log has odometry in its scans only
  int stamp_inversions = 0;     ///< scans in the file whose stamp is before the one of the scan above them
  int odometry_inversions = 0;  ///< likewise for odometry
  int other_lines = 0;          ///< messages that say nothing about scans or odometry
  double range_limit_m =
      0.0;  ///< from which FLASER readings were taken for none (range_limit.hpp); 0: none were
  std::size_t readings_beyond = 0;  ///< so many were
  int flaser_ignored = 0;           ///< FLASER lines of a log that has the richer ROBOTLASER1 too
};

/// Reads a CARMEN log (.clf, .clf.gz, .clf.bz2): FLASER, ROBOTLASER1 and ODOM; other messages are counted.
/// FLASER readings that pile up at the log's longest range did not come back (piled_up_range_m).
/// Errors say file, line, what was found and what is expected: kNotFound, kPermission, kIo, and kInvalidInput
/// for damaged or truncated input, a wrong count, a number that is none, a missing stamp, and a log with no
/// scan.
types::Result<CarmenLog> read_carmen_log(const std::string& path);

/// Reads a log of the Mines robot (Hokuyo URG-04LX and wheel encoders; columns as in tinySLAM's test data)
/// into the same form. The odometry is integrated from the encoders, starting at the origin. Errors as above.
types::Result<CarmenLog> read_mines_log(const std::string& path);

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/carmen_log.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/types/scan.hpp"
#include "tests/bench/carmen/fields.hpp"
#include "tests/bench/carmen/log_order.hpp"
#include "tests/bench/carmen/range_limit.hpp"

namespace topo::bench {

using types::Errc;
using types::fail;
using types::Result;
using types::Status;

namespace {

constexpr double kSickReach_m = 80.0;  // an LMS in 80 m mode sends 81.83 or 81.91 without a return
constexpr double kMaxRange_m = 1000.0;
constexpr std::size_t kTail = 3;  // every message ends with: ipc_ts host logger_ts

constexpr float radians(double degrees) { return static_cast<float>(degrees * types::kDegree_rad); }

/// FLASER gives neither start angle nor step: they follow from the number of beams of a SICK LMS 200.
void set_flaser_angles(CarmenScan& scan, std::size_t beams) {
  double start_deg = -90.0, step_deg = 180.0 / static_cast<double>(beams - 1);
  if (beams == 180) step_deg = 1.0;
  if (beams == 360) step_deg = 0.5;
  if (beams == 400 || beams == 401) {  // the 100 degree mode
    start_deg = -50.0;
    step_deg = 0.25;
  }
  scan.angle_min_rad = radians(start_deg);
  scan.angle_increment_rad = radians(step_deg);
}

Status read_ranges(const Fields& f, std::size_t first, std::size_t beams, CarmenScan& scan) {
  scan.range_m.resize(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const auto range = f.number(first + i, "range", 0.0, kMaxRange_m);
    if (!range.has_value()) return tl::unexpected(range.error());
    const auto metres = static_cast<float>(*range);
    scan.range_m[i] = metres >= scan.range_max_m ? types::kNoReturn
                      : metres > 0.0F            ? metres
                                                 : types::kInvalid;
  }
  return {};
}

Status read_poses(const Fields& f, std::size_t first, CarmenScan& scan) {
  const auto laser = f.pose(first, "laser pose");
  if (!laser.has_value()) return tl::unexpected(laser.error());
  const auto robot = f.pose(first + 3, "robot pose");
  if (!robot.has_value()) return tl::unexpected(robot.error());
  scan.laser_odom = *laser;
  scan.robot_odom = *robot;
  return {};
}

Status read_stamp(const Fields& f, double& stamp_s) {
  const auto stamp = f.stamp(f.count() - kTail, "ipc_timestamp");
  if (!stamp.has_value()) return tl::unexpected(stamp.error());
  stamp_s = *stamp;
  return {};
}

Status read_flaser(const Fields& f, CarmenScan& scan) {
  constexpr std::string_view kLayout =
      "FLASER n r1..rn x y theta odom_x odom_y odom_theta ipc_timestamp ipc_hostname logger_timestamp";
  if (f.count() < 2) return f.expect_count(2 + 2 + 6 + kTail, kLayout);
  const auto beams = f.count_field(1, "number of ranges", 2, types::Scan::kMaxBeams);
  if (!beams.has_value()) return tl::unexpected(beams.error());
  if (auto s = f.expect_count(2 + *beams + 6 + kTail, kLayout); !s.has_value()) return s;
  set_flaser_angles(scan, *beams);
  scan.range_max_m = static_cast<float>(kSickReach_m);
  if (auto s = read_ranges(f, 2, *beams, scan); !s.has_value()) return s;
  if (auto s = read_poses(f, 2 + *beams, scan); !s.has_value()) return s;
  return read_stamp(f, scan.stamp_s);
}

Status read_robotlaser_head(const Fields& f, CarmenScan& scan) {
  const auto start = f.number(2, "start_angle", -7.0, 7.0);
  if (!start.has_value()) return tl::unexpected(start.error());
  const auto step = f.number(4, "angular_resolution", 1e-5, 1.0);
  if (!step.has_value()) return tl::unexpected(step.error());
  const auto reach = f.number(5, "maximum_range", 1e-3, kMaxRange_m);
  if (!reach.has_value()) return tl::unexpected(reach.error());
  scan.angle_min_rad = static_cast<float>(*start);
  scan.angle_increment_rad = static_cast<float>(*step);
  scan.range_max_m = static_cast<float>(*reach);
  return {};
}

Status read_robotlaser(const Fields& f, CarmenScan& scan) {
  constexpr std::string_view kLayout =
      "ROBOTLASER1 laser_type start_angle field_of_view angular_resolution maximum_range accuracy "
      "remission_mode n "
      "r1..rn m e1..em laser_pose(3) robot_pose(3) tv rv forward_safety side_safety turn_axis ipc_timestamp "
      "ipc_hostname logger_timestamp";
  constexpr std::size_t kHead = 9, kAfterPoses = 5;
  if (f.count() < kHead) return f.expect_count(kHead + 1 + 6 + kAfterPoses + kTail, kLayout);
  if (auto s = read_robotlaser_head(f, scan); !s.has_value()) return s;
  const auto beams = f.count_field(8, "number of ranges", 2, types::Scan::kMaxBeams);
  if (!beams.has_value()) return tl::unexpected(beams.error());
  if (f.count() < kHead + *beams + 1)
    return f.expect_count(kHead + *beams + 1 + 6 + kAfterPoses + kTail, kLayout);
  const auto remissions = f.count_field(kHead + *beams, "number of remissions", 0, types::Scan::kMaxBeams);
  if (!remissions.has_value()) return tl::unexpected(remissions.error());
  const std::size_t poses = kHead + *beams + 1 + *remissions;
  if (auto s = f.expect_count(poses + 6 + kAfterPoses + kTail, kLayout); !s.has_value()) return s;
  if (auto s = read_ranges(f, kHead, *beams, scan); !s.has_value()) return s;
  if (auto s = read_poses(f, poses, scan); !s.has_value()) return s;
  return read_stamp(f, scan.stamp_s);
}

Status read_odometry(const Fields& f, CarmenOdometry& odometry) {
  if (auto s =
          f.expect_count(7 + kTail, "ODOM x y theta tv rv accel ipc_timestamp ipc_hostname logger_timestamp");
      !s.has_value()) {
    return s;
  }
  const auto pose = f.pose(1, "pose");
  if (!pose.has_value()) return tl::unexpected(pose.error());
  const auto v = f.number(4, "tv", -100.0, 100.0);
  if (!v.has_value()) return tl::unexpected(v.error());
  const auto omega = f.number(5, "rv", -100.0, 100.0);
  if (!omega.has_value()) return tl::unexpected(omega.error());
  odometry.pose = *pose;
  odometry.v_mps = *v;
  odometry.omega_radps = *omega;
  return read_stamp(f, odometry.stamp_s);
}

/// Scans by their type of message, while a log is read.
struct Collected {
  CarmenLog log;
  std::vector<CarmenScan> flaser;
  std::vector<CarmenScan> robotlaser;
};

bool is_message_name(std::string_view word) {
  if (word.front() < 'A' || word.front() > 'Z') return false;
  return word.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789") == std::string_view::npos;
}

Status read_line(const Fields& f, Collected& into) {
  if (f.is_comment()) return {};
  const std::string_view name = f.word(0);
  if (name == "FLASER") return read_flaser(f, into.flaser.emplace_back());
  if (name == "ROBOTLASER1") return read_robotlaser(f, into.robotlaser.emplace_back());
  if (name == "ODOM") return read_odometry(f, into.log.odometry.emplace_back());
  if (!is_message_name(name))
    return f.bad(0, "message name", "a CARMEN message such as FLASER, ODOM or PARAM");
  ++into.log.other_lines;
  return {};
}

}  // namespace

Result<CarmenLog> read_carmen_log(const std::string& path) {
  auto source = LineSource::open(path);
  if (!source.has_value()) return tl::unexpected(source.error());
  Collected found;
  const auto whole = read_lines(*source, [&found](const Fields& f) { return read_line(f, found); });
  if (!whole.has_value()) return tl::unexpected(whole.error());
  if (found.flaser.empty() && found.robotlaser.empty()) {
    return fail(Errc::kInvalidInput,
                fmt::format("{}: found no scan in {} lines, expected a CARMEN log with FLASER or "
                            "ROBOTLASER1 messages",
                            path, source->line()));
  }
  CarmenLog log = std::move(found.log);
  if (!found.robotlaser.empty()) log.flaser_ignored = static_cast<int>(found.flaser.size());
  const bool states_limit = !found.robotlaser.empty();  // every ROBOTLASER1 message does
  log.scans = std::move(states_limit ? found.robotlaser : found.flaser);
  if (!states_limit) {
    if (const auto limit_m = piled_up_range_m(log.scans)) {
      log.range_limit_m = static_cast<double>(*limit_m);
      log.readings_beyond = mark_no_return(log.scans, *limit_m);
    }
  }
  log.stamp_inversions = sort_by_stamp(log.scans);
  log.odometry_inversions = sort_by_stamp(log.odometry);
  return log;
}

}  // namespace topo::bench

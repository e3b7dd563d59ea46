// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/carmen_lines.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/types/scan.hpp"

namespace topo::bench {

using types::Result;
using types::Status;

namespace {

constexpr double kMaxRange_m = 1000.0;
constexpr std::size_t kTail = 3;  // every message ends with: ipc_ts host logger_ts
constexpr std::size_t kHead = 9;  // words of ROBOTLASER and RAWLASER before the readings
constexpr double kLeastStep_rad = 1e-5;

Status read_ranges(const Fields& f, std::size_t first, std::size_t beams, CarmenScan& scan) {
  scan.range_m.resize(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const auto range = f.number(first + i, "range", 0.0, kMaxRange_m);
    if (!range) return tl::unexpected(range.error());
    const auto metres = static_cast<float>(*range);
    scan.range_m[i] = metres > 0.0F ? metres : types::kInvalid;
  }
  return {};
}

Status read_poses(const Fields& f, std::size_t first, CarmenScan& scan) {
  const auto laser = f.pose(first, "laser pose");
  if (!laser) return tl::unexpected(laser.error());
  const auto robot = f.pose(first + 3, "robot pose");
  if (!robot) return tl::unexpected(robot.error());
  scan.laser_odom = *laser;
  scan.robot_odom = *robot;
  return {};
}

Status read_stamp(const Fields& f, double& stamp_s) {
  const auto stamp = f.stamp(f.count() - kTail, "ipc_timestamp");
  if (!stamp) return tl::unexpected(stamp.error());
  stamp_s = *stamp;
  return {};
}

/// What a message says of its beams.
struct Fan {
  double start_rad = 0.0, view_rad = 0.0, step_rad = 0.0;

  [[nodiscard]] double step_of_view(std::size_t beams) const {
    return view_rad / static_cast<double>(beams - 1);
  }
  /// A field of view counts n or n - 1 steps.
  [[nodiscard]] bool agrees(std::size_t beams) const {
    constexpr double kSlack_steps = 1.5;
    return std::abs(view_rad - step_rad * static_cast<double>(beams - 1)) <= kSlack_steps * step_rad;
  }
  [[nodiscard]] double middle_rad(std::size_t beams, double step) const {
    return start_rad + 0.5 * step * static_cast<double>(beams - 1);
  }
  [[nodiscard]] double step_to_hold(std::size_t beams) const {
    if (agrees(beams) || view_rad <= 0.0) return step_rad;
    const double by_view = step_of_view(beams);
    if (step_rad < kLeastStep_rad) return by_view;
    const bool around = step_rad * static_cast<double>(beams - 1) > 2.0 * std::numbers::pi;
    const bool ahead =
        std::abs(middle_rad(beams, by_view)) <= by_view && std::abs(middle_rad(beams, step_rad)) > step_rad;
    return around || ahead ? by_view : step_rad;
  }
};

Result<Fan> read_fan(const Fields& f) {
  const auto start = f.number(2, "start_angle", -7.0, 7.0);
  if (!start) return tl::unexpected(start.error());
  const auto view = f.number(3, "field_of_view", 0.0, 7.0);
  if (!view) return tl::unexpected(view.error());
  const auto step = f.number(4, "angular_resolution", 0.0, 1.0);
  if (!step) return tl::unexpected(step.error());
  if (*step < kLeastStep_rad && *view <= 0.0)
    return f.bad(4, "angular_resolution", fmt::format("at least {}, or a field of view", kLeastStep_rad));
  return Fan{*start, *view, *step};
}

/// Head, readings and remissions; returns the number of words up to there.
Result<std::size_t> read_sweep(const Fields& f, std::string_view layout, std::size_t after,
                               CarmenScan& scan) {
  const auto short_of = [&](std::size_t words) {
    return tl::unexpected(f.expect_count(words + after, layout).error());
  };
  if (f.count() < kHead) return short_of(kHead + 1);
  const auto fan = read_fan(f);
  if (!fan) return tl::unexpected(fan.error());
  const auto reach = f.number(5, "maximum_range", 1e-3, kMaxRange_m);
  if (!reach) return tl::unexpected(reach.error());
  const auto beams = f.count_field(8, "number of ranges", 2, types::Scan::kMaxBeams);
  if (!beams) return tl::unexpected(beams.error());
  if (f.count() < kHead + *beams + 1) return short_of(kHead + *beams + 1);
  const auto remissions = f.count_field(kHead + *beams, "number of remissions", 0, types::Scan::kMaxBeams);
  if (!remissions) return tl::unexpected(remissions.error());
  const std::size_t words = kHead + *beams + 1 + *remissions;
  if (auto s = f.expect_count(words + after, layout); !s) return tl::unexpected(s.error());
  if (auto s = read_ranges(f, kHead, *beams, scan); !s) return tl::unexpected(s.error());
  scan.angle_min_rad = static_cast<float>(fan->start_rad);
  scan.angle_increment_rad = static_cast<float>(fan->step_to_hold(*beams));
  scan.range_max_m = static_cast<float>(*reach);
  mark_beyond_reach(scan);
  return words;
}

/// The end of a line with poses: those from word `first` on, and the stamp.
Result<CarmenScan> read_poses_and_stamp(const Fields& f, std::size_t first, CarmenScan& scan) {
  if (auto s = read_poses(f, first, scan); !s) return tl::unexpected(s.error());
  if (auto s = read_stamp(f, scan.stamp_s); !s) return tl::unexpected(s.error());
  return scan;
}

}  // namespace

void mark_beyond_reach(CarmenScan& scan) {
  for (float& range : scan.range_m) {
    if (range >= scan.range_max_m) range = types::kNoReturn;
  }
}

bool states_two_fans(const Fields& f) {
  const auto fan = read_fan(f);
  const auto beams = f.count_field(8, "number of ranges", 2, types::Scan::kMaxBeams);
  return fan && beams && fan->view_rad > 0.0 && fan->step_rad >= kLeastStep_rad && !fan->agrees(*beams);
}

Result<CarmenScan> read_flaser(const Fields& f) {
  constexpr std::string_view kLayout =
      "FLASER n r1..rn x y theta odom_x odom_y odom_theta ipc_timestamp ipc_hostname logger_timestamp";
  CarmenScan scan;
  if (f.count() < 2) return tl::unexpected(f.expect_count(2 + 2 + 6 + kTail, kLayout).error());
  const auto beams = f.count_field(1, "number of ranges", 2, types::Scan::kMaxBeams);
  if (!beams) return tl::unexpected(beams.error());
  if (auto s = f.expect_count(2 + *beams + 6 + kTail, kLayout); !s) return tl::unexpected(s.error());
  if (auto s = read_ranges(f, 2, *beams, scan); !s) return tl::unexpected(s.error());
  return read_poses_and_stamp(f, 2 + *beams, scan);
}

Result<CarmenScan> read_robotlaser(const Fields& f) {
  constexpr std::string_view kLayout =
      "ROBOTLASER1 laser_type start_angle field_of_view angular_resolution maximum_range accuracy "
      "remission_mode n "
      "r1..rn m e1..em laser_pose(3) robot_pose(3) tv rv forward_safety side_safety turn_axis ipc_timestamp "
      "ipc_hostname logger_timestamp";
  constexpr std::size_t kAfterPoses = 5;
  CarmenScan scan;
  const auto words = read_sweep(f, kLayout, 6 + kAfterPoses + kTail, scan);
  if (!words) return tl::unexpected(words.error());
  return read_poses_and_stamp(f, *words, scan);
}

Result<CarmenScan> read_rawlaser(const Fields& f) {
  constexpr std::string_view kLayout =
      "RAWLASER1 laser_type start_angle field_of_view angular_resolution maximum_range accuracy "
      "remission_mode n "
      "r1..rn m e1..em ipc_timestamp ipc_hostname logger_timestamp";
  CarmenScan scan;
  if (const auto words = read_sweep(f, kLayout, kTail, scan); !words) return tl::unexpected(words.error());
  if (auto s = read_stamp(f, scan.stamp_s); !s) return tl::unexpected(s.error());
  return scan;
}

Result<CarmenOdometry> read_odometry(const Fields& f) {
  constexpr std::string_view kLayout =
      "ODOM x y theta tv rv accel ipc_timestamp ipc_hostname logger_timestamp";
  if (auto s = f.expect_count(7 + kTail, kLayout); !s) return tl::unexpected(s.error());
  CarmenOdometry odometry;
  const auto pose = f.pose(1, "pose");
  if (!pose) return tl::unexpected(pose.error());
  const auto v = f.number(4, "tv", -100.0, 100.0);
  if (!v) return tl::unexpected(v.error());
  const auto omega = f.number(5, "rv", -100.0, 100.0);
  if (!omega) return tl::unexpected(omega.error());
  odometry.pose = *pose;
  odometry.v_mps = *v;
  odometry.omega_radps = *omega;
  if (auto s = read_stamp(f, odometry.stamp_s); !s) return tl::unexpected(s.error());
  return odometry;
}

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The log of the Mines ParisTech robot published with tinySLAM (Steux and El Hamzaoui, 2010): one line per
// scan; column 0 time in microseconds, columns 2 and 3 the left and right encoder, from column 24 the ranges
// in millimetres.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/types/scan.hpp"
#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/carmen/fields.hpp"
#include "tests/bench/carmen/log_order.hpp"
#include "tests/bench/carmen/passed_over.hpp"

namespace topo::bench {

using types::Errc;
using types::fail;
using types::Result;
using types::Se2;
using types::Status;

namespace {

constexpr std::size_t kFirstRange = 24, kBeams = 682, kMinColumns = kFirstRange + kBeams;
constexpr double kWheelRadius_m = 0.077, kHalfAxle_m = 0.165, kLaserAhead_m = 0.145;
// 2000 ticks per revolution. tinySLAM's "degrees = ticks * 180 / 2000" is half of the angle: tinySLAM adds
// the distances of both wheels instead of taking the mean, and divides their difference by half the axle.
constexpr double kWheel_rad_per_tick = 2.0 * std::numbers::pi / 2000.0;
constexpr double kUrgReach_m = 4.0;
constexpr double kUrgMin_mm = 20.0;  // below: error codes of the URG-04LX (PROTOCOLS 10.2)
// The URG-04LX has 1024 steps per revolution and sends steps 44 to 725; step 384 points ahead (PROTOCOLS 11).
constexpr double kStep_rad = 2.0 * std::numbers::pi / 1024.0;
constexpr double kFirstStep = 44.0 - 384.0;
// A sweep takes 67 ms of a revolution, during which this robot turns by up to 7 degrees.
constexpr double kRevolution_s = 0.1;

struct Encoders {
  double stamp_s = 0.0;
  double left_ticks = 0.0;
  double right_ticks = 0.0;
};

Result<Encoders> read_encoders(const Fields& f) {
  const auto time_us = f.number(0, "time in microseconds", 0.0, 9e15);
  if (!time_us.has_value()) return tl::unexpected(time_us.error());
  const auto left = f.number(2, "left encoder", -1e12, 1e12);
  if (!left.has_value()) return tl::unexpected(left.error());
  const auto right = f.number(3, "right encoder", -1e12, 1e12);
  if (!right.has_value()) return tl::unexpected(right.error());
  return Encoders{*time_us * 1e-6, *left, *right};
}

/// The pose after the encoders' motion from `pose`, along an arc.
Se2 drive(const Se2& pose, const Encoders& from, const Encoders& to) {
  const double left_m = (to.left_ticks - from.left_ticks) * kWheel_rad_per_tick * kWheelRadius_m;
  const double right_m = (to.right_ticks - from.right_ticks) * kWheel_rad_per_tick * kWheelRadius_m;
  const double turn_rad = (right_m - left_m) / (2.0 * kHalfAxle_m);
  const double way_m = 0.5 * (left_m + right_m);
  const Se2 half{0.0, 0.0, 0.5 * turn_rad};
  return pose * half * Se2{way_m, 0.0, 0.0} * half;
}

Status read_ranges(const Fields& f, CarmenScan& scan) {
  scan.range_m.resize(kBeams);
  for (std::size_t i = 0; i < kBeams; ++i) {
    const auto mm = f.number(kFirstRange + i, "range in millimetres", 0.0, 65535.0);
    if (!mm.has_value()) return tl::unexpected(mm.error());
    const auto metres = static_cast<float>(*mm * 1e-3);
    scan.range_m[i] = *mm < kUrgMin_mm             ? types::kInvalid
                      : metres >= scan.range_max_m ? types::kNoReturn
                                                   : metres;
  }
  return {};
}

Status read_scan(const Fields& f, const Se2& pose, double stamp_s, CarmenLog& log) {
  CarmenScan& scan = log.scans.emplace_back();
  scan.stamp_s = stamp_s;
  scan.angle_min_rad = static_cast<float>(kFirstStep * kStep_rad);
  scan.angle_increment_rad = static_cast<float>(kStep_rad);
  scan.time_increment_s = static_cast<float>(kRevolution_s / 1024.0);
  scan.range_max_m = static_cast<float>(kUrgReach_m);
  scan.robot_odom = pose;
  scan.laser_odom = pose * Se2{kLaserAhead_m, 0.0, 0.0};
  log.odometry.push_back({stamp_s, pose, 0.0, 0.0});
  return read_ranges(f, scan);
}

/// The encoders give positions only; the speed at each position is that of the step that ends there.
void fill_speeds(std::vector<CarmenOdometry>& odometry) {
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    const double dt_s = odometry[i].stamp_s - odometry[i - 1].stamp_s;
    if (dt_s <= 0.0) continue;
    const Se2 step = odometry[i - 1].pose.inverse() * odometry[i].pose;
    odometry[i].v_mps = std::copysign(std::hypot(step.x_m, step.y_m), step.x_m) / dt_s;
    odometry[i].omega_radps = step.theta_rad / dt_s;
  }
}

}  // namespace

Result<CarmenLog> read_mines_log(const std::string& path) {
  auto source = LineSource::open(path);
  if (!source.has_value()) return tl::unexpected(source.error());
  CarmenLog log;
  Encoders last;
  Se2 pose;
  PassedOver foreign;
  const auto take = [&](const Fields& f) -> Status {
    if (f.count() < kMinColumns || f.count() > kMinColumns + 1)
      return source->bad(fmt::format("{} columns", f.count()), fmt::format("{} or one more", kMinColumns));
    const auto now = read_encoders(f);
    if (!now.has_value()) return tl::unexpected(now.error());
    if (!log.scans.empty()) pose = drive(pose, last, *now);
    last = *now;
    return read_scan(f, pose, now->stamp_s, log);
  };
  const auto whole = read_lines(*source, [&](const Fields& f) -> Status {
    if (!parse_number(f.word(0))) {
      foreign.add(source->line(), f.word(0));
      return {};
    }
    const std::size_t scans = log.scans.size();
    const Status taken = take(f);
    if (taken.has_value() || !source->is_cut()) return taken;
    log.scans.resize(scans);
    log.odometry.resize(scans);
    log.remarks.push_back(fmt::format("passed over the last line, {}, which was cut off", source->line()));
    return {};
  });
  if (!whole.has_value()) return tl::unexpected(whole.error());
  if (foreign.count() > 0) log.remarks.push_back(foreign.remark("without a time at the beginning"));
  log.foreign_lines = foreign.count();
  if (log.scans.empty()) {
    return fail(Errc::kInvalidInput,
                fmt::format("{}: found no scan{}{}, expected lines of {} columns", path,
                            log.remarks.empty() ? "" : ", but ",
                            log.remarks.empty() ? "" : log.remarks.front(), kMinColumns));
  }
  log.stamp_inversions = sort_by_stamp(log.scans);
  log.odometry_inversions = sort_by_stamp(log.odometry);
  fill_speeds(log.odometry);
  return log;
}

}  // namespace topo::bench

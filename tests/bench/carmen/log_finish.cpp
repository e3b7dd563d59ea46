// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/log_finish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/carmen/carmen_lines.hpp"
#include "tests/bench/carmen/log_order.hpp"
#include "tests/bench/carmen/range_limit.hpp"

namespace topo::bench {

using types::Errc;
using types::fail;
using types::Se2;
using types::Status;

namespace {

constexpr double kSickReach_m = 80.0;  // an LMS in 80 m mode sends 81.83 or 81.91 without a return

double degrees(double rad) { return rad / types::kDegree_rad; }

tl::unexpected<types::Error> unknown_beams(const SweepContext& context, std::size_t beams, int line) {
  return fail(
      Errc::kInvalidInput,
      fmt::format("{}:{}: found {} ranges in {}, which does not say where they point, expected the number of "
                  "a known scanner ({}), PARAM lines that fit, or the option --beams START,STEP (degrees)",
                  context.path, line, beams, context.message, known_beam_counts()));
}

/// Angles and reach of messages that state neither.
Status fill_angles(const SweepContext& context, Sweeps& sweeps, CarmenLog& log) {
  if (context.options.beams && context.options.beams->step_rad == 0.0)
    return fail(Errc::kInvalidInput, "--beams: found a step of 0, expected degrees from beam to beam");
  for (const auto& [beams, line] : sweeps.first_line) {
    const auto angles = angles_of(beams, context.facts, context.options);
    if (!angles) return unknown_beams(context, beams, line);
    const auto usual = usual_angles(beams);
    const bool as_usual = usual && std::abs(usual->first_rad - angles->first_rad) < 0.5 * usual->step_rad &&
                          std::abs(usual->step_rad - angles->step_rad) < 1e-3 * usual->step_rad;
    if (!as_usual && !context.options.beams) {
      log.remarks.push_back(
          fmt::format("took {} beams of {:.4g} degrees from {:.4g} on, as its PARAM lines say", beams,
                      degrees(angles->step_rad), degrees(angles->first_rad)));
    }
    for (CarmenScan& scan : sweeps.scans) {
      if (scan.range_m.size() != beams) continue;
      scan.angle_min_rad = static_cast<float>(angles->first_rad);
      scan.angle_increment_rad = static_cast<float>(angles->step_rad);
    }
  }
  for (CarmenScan& scan : sweeps.scans) {
    scan.range_max_m = static_cast<float>(context.facts.reach_m.value_or(kSickReach_m));
    mark_beyond_reach(scan);
  }
  if (const auto limit_m = piled_up_range_m(sweeps.scans)) {
    log.range_limit_m = static_cast<double>(*limit_m);
    log.readings_beyond = mark_no_return(sweeps.scans, *limit_m);
  }
  return {};
}

/// The pose at a stamp between two samples; nothing when they are too far apart or there are none.
std::optional<Se2> pose_at(const std::vector<CarmenOdometry>& odometry, double stamp_s, double gap_max_s) {
  const auto after = std::lower_bound(odometry.begin(), odometry.end(), stamp_s,
                                      [](const CarmenOdometry& o, double t) { return o.stamp_s < t; });
  if (after == odometry.end()) return std::nullopt;
  if (after->stamp_s == stamp_s) return after->pose;
  if (after == odometry.begin()) return std::nullopt;
  const CarmenOdometry& before = *(after - 1);
  const double gap_s = after->stamp_s - before.stamp_s;
  if (gap_s > gap_max_s) return std::nullopt;
  return types::interpolate(before.pose, after->pose, (stamp_s - before.stamp_s) / gap_s);
}

/// Poses of messages that have none.
Status fill_poses(const SweepContext& context, Sweeps& sweeps, CarmenLog& log) {
  const std::size_t all = sweeps.scans.size();
  const Se2 T_robot_laser = context.facts.T_robot_laser();
  std::erase_if(sweeps.scans, [&](CarmenScan& scan) {
    const auto pose = pose_at(log.odometry, scan.stamp_s, context.options.odometry_gap_max_s);
    if (!pose) return true;
    scan.robot_odom = *pose;
    scan.laser_odom = *pose * T_robot_laser;
    return false;
  });
  if (sweeps.scans.empty()) {
    return fail(
        Errc::kInvalidInput,
        fmt::format(
            "{}: found {} of {}, which have no poses, and {} of ODOM, expected ODOM messages before and "
            "after the scans, {} s apart at most",
            context.path, all, context.message, log.odometry.size(), context.options.odometry_gap_max_s));
  }
  if (sweeps.scans.size() < all) {
    log.remarks.push_back(fmt::format("passed over {} of {} {} messages, which have no odometry around them",
                                      all - sweeps.scans.size(), all, context.message));
  }
  log.remarks.push_back(fmt::format(
      "took the poses of {} from ODOM, and the scanner {:.3g} m before the robot's centre, {}",
      context.message, T_robot_laser.x_m,
      context.facts.says_place() ? "as its PARAM lines say" : "because no PARAM line says where it is"));
  return {};
}

/// Messages with poses of robot and scanner that are the same everywhere do not say where the scanner is; the
/// log's PARAM line does.
void place_scanner(const SweepContext& context, Sweeps& sweeps, CarmenLog& log) {
  const Se2 T_robot_laser = context.facts.T_robot_laser();
  if (T_robot_laser == Se2{}) return;
  const bool silent = std::all_of(sweeps.scans.begin(), sweeps.scans.end(),
                                  [](const CarmenScan& scan) { return scan.laser_odom == scan.robot_odom; });
  if (!silent) return;
  for (CarmenScan& scan : sweeps.scans) scan.laser_odom = scan.robot_odom * T_robot_laser;
  log.remarks.push_back(fmt::format(
      "took the scanner {:.3g} m before the robot's centre, as its PARAM lines say: {} gives both one pose",
      T_robot_laser.x_m, context.message));
}

}  // namespace

Status finish_sweeps(const SweepContext& context, Sweeps& sweeps, CarmenLog& log) {
  if (sweeps.error) return tl::unexpected(*sweeps.error);
  if (sweeps.two_fans > 0) {
    log.remarks.push_back(
        fmt::format("found a field of view that is not the number of beams times the resolution in {} of {} "
                    "{} messages, took "
                    "beams of {:.4g} degrees",
                    sweeps.two_fans, sweeps.scans.size(), context.message,
                    degrees(static_cast<double>(sweeps.scans.front().angle_increment_rad))));
  }
  if (sweeps.layout == Layout::kFlaser) {
    if (auto s = fill_angles(context, sweeps, log); !s) return s;
  }
  if (sweeps.layout == Layout::kRawLaser) {
    if (auto s = fill_poses(context, sweeps, log); !s) return s;
  } else {
    place_scanner(context, sweeps, log);
  }
  log.scans = std::move(sweeps.scans);
  log.stamp_inversions = sort_by_stamp(log.scans);
  return {};
}

}  // namespace topo::bench

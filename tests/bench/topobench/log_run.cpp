// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/log_run.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace topo::bench {

types::Result<CarmenLog> read_log(const std::string& path, const LogOptions& options) {
  return path.find(".dat") != std::string::npos ? read_mines_log(path) : read_carmen_log(path, options);
}

LogOptions options_of(std::span<const double> beams_deg) {
  LogOptions options;
  if (beams_deg.size() == 2)
    options.beams = BeamAngles{beams_deg[0] * types::kDegree_rad, beams_deg[1] * types::kDegree_rad};
  return options;
}

void print_remarks(const std::string& path, const CarmenLog& log) {
  for (const std::string& remark : log.remarks) fmt::print(stderr, "topobench: {}: {}\n", path, remark);
}

void fill_scan(const CarmenScan& from, double stamp_s, std::uint64_t sequence, types::Scan& to) {
  to.beams = static_cast<std::uint16_t>(std::min(from.range_m.size(), types::Scan::kMaxBeams));
  to.arrival = types::stamp_from_seconds(stamp_s);
  const int gaps = to.beams > 0 ? to.beams - 1 : 0;
  to.first_beam = to.arrival - types::from_seconds(static_cast<double>(from.time_increment_s) * gaps);
  to.sequence = sequence;
  to.geometry = {from.angle_min_rad, from.angle_increment_rad, from.time_increment_s, 0.0F, 0.02F,
                 from.range_max_m};
  to.has_intensity = false;
  std::copy_n(from.range_m.begin(), to.beams, to.range_m.begin());
}

MappingRun run_log(const CarmenLog& log, pipeline::MappingState& state) {
  LockStep lock_step(state);
  types::Scan scan;
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    fill_scan(log.scans[i], log.scans[i].stamp_s, i, scan);
    const types::Odometry odometry{
        scan.arrival, types::Transform2<types::Odom, types::Base>(log.scans[i].robot_odom), {}};
    lock_step.step({{&odometry, 1}, &scan, nullptr});
  }
  return lock_step.finish();
}

slam::MapperParams params_for(const CarmenLog& log) {
  slam::MapperParams params;
  if (!log.scans.empty()) {
    params.T_base_laser = log.scans.front().robot_odom.inverse() * log.scans.front().laser_odom;
  }
  return params;
}

}  // namespace topo::bench

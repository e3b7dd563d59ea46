// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/log_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <deque>

namespace topo::bench {
namespace {

using WallClock = std::chrono::steady_clock;

double elapsed_ms(WallClock::time_point since) {
  return std::chrono::duration<double, std::milli>(WallClock::now() - since).count();
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A scan's place relative to its keyframe, to be corrected when the log has ended.
struct Hung {
  double stamp_s;
  std::size_t node;
  types::Se2 T_node_base;
};

class Runner {
 public:
  Runner(const daemon::CarmenLog& log, pipeline::MappingState& state, const LogRunOptions& options)
      : log_(log), state_(state), options_(options) {}

  LogRun run() {
    const double cpu = cpu_seconds();
    const auto wall = WallClock::now();
    types::Scan scan;
    for (std::size_t i = 0; i < log_.scans.size(); ++i) step(log_.scans[i], i, scan);
    while (!answers_.empty()) hand_over();
    collect(state_.finish());
    run_.cpu_s = cpu_seconds() - cpu;
    run_.wall_s = elapsed_ms(wall) / 1e3;
    place();
    return std::move(run_);
  }

 private:
  struct Waiting {
    std::size_t due;
    slam::LoopAnswer answer;
  };

  void step(const daemon::CarmenScan& from, std::size_t sequence, types::Scan& scan) {
    fill_scan(from, sequence, scan);
    const types::Odometry odometry{
        scan.first_beam, types::Transform2<types::Odom, types::Base>(from.robot_odom), {}};
    while (!answers_.empty() && answers_.front().due <= keyframes_) hand_over();
    const auto begin = WallClock::now();
    pipeline::MappingOutput output = mapping_step(state_, {{&odometry, 1}, &scan, nullptr});
    run_.match_ms.push_back(elapsed_ms(begin));
    stamps_.push_back(from.stamp_s);
    collect(std::move(output));
  }

  void collect(pipeline::MappingOutput output) {
    for (const slam::MatchReport& match : output.matches) {
      hung_.push_back({stamps_[hung_.size()], match.node, match.T_node_base});
      keyframes_ += match.keyframe ? 1 : 0;
      run_.lost += match.matched ? 0 : 1;
      run_.searched += match.searched ? 1 : 0;
    }
    for (const slam::LoopVerdict& verdict : output.loop_verdicts) {
      run_.closures_accepted += verdict.accepted;
      run_.closures_rejected += verdict.rejected;
    }
    for (const slam::LoopQuery& query : output.loop_queries) {
      const auto begin = WallClock::now();
      answers_.push_back({keyframes_ + options_.answer_delay, slam::find_closures(query)});
      run_.closure_ms.push_back(elapsed_ms(begin));
    }
  }

  void hand_over() {
    state_.offer(std::move(answers_.front().answer));
    answers_.pop_front();
  }

  void place() {
    const std::span<const types::Se2> poses = state_.mapper().poses();
    for (const Hung& hung : hung_) {
      run_.trajectory.push_back({hung.stamp_s, poses[hung.node] * hung.T_node_base});
      if (run_.trajectory.size() < 2) continue;
      const types::Se2& a = run_.trajectory[run_.trajectory.size() - 2].pose;
      const types::Se2& b = run_.trajectory.back().pose;
      run_.path_m += std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    }
  }

  const daemon::CarmenLog& log_;
  pipeline::MappingState& state_;
  LogRunOptions options_;
  LogRun run_;
  std::vector<double> stamps_;
  std::vector<Hung> hung_;
  std::deque<Waiting> answers_;
  std::size_t keyframes_ = 0;
};

}  // namespace

types::Result<daemon::CarmenLog> read_log(const std::string& path) {
  return path.find(".dat") != std::string::npos ? daemon::read_mines_log(path)
                                                : daemon::read_carmen_log(path);
}

void fill_scan(const daemon::CarmenScan& from, std::uint64_t sequence, types::Scan& to) {
  to.first_beam = to.arrival = types::stamp_from_seconds(from.stamp_s);
  to.sequence = sequence;
  to.beams = static_cast<std::uint16_t>(std::min(from.range_m.size(), types::Scan::kMaxBeams));
  to.geometry = {from.angle_min_rad, from.angle_increment_rad, 0.0F, 0.0F, 0.02F, from.range_max_m};
  to.has_intensity = false;
  std::copy_n(from.range_m.begin(), to.beams, to.range_m.begin());
}

LogRun run_log(const daemon::CarmenLog& log, pipeline::MappingState& state, const LogRunOptions& options) {
  return Runner(log, state, options).run();
}

slam::MapperParams params_for(const daemon::CarmenLog& log) {
  slam::MapperParams params;
  if (!log.scans.empty()) {
    params.T_base_laser = log.scans.front().robot_odom.inverse() * log.scans.front().laser_odom;
  }
  return params;
}

}  // namespace topo::bench

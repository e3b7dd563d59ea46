// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Logs of other robots, plain or packed, of any content: refused with the line, or scans and poses in the
// order of their stamps, all of them numbers.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "core/types/scan.hpp"
#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/carmen/relations.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace {

using namespace topo;

void require(bool holds) {
  if (!holds) std::abort();
}

bool is_finite(const types::Se2& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.theta_rad);
}

void check_log(const types::Result<bench::CarmenLog>& log, const std::string& path) {
  if (!log) {
    require(log.error().message.starts_with(path));
    return;
  }
  require(!log->scans.empty() && log->stamp_inversions >= 0);
  const auto earlier = [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; };
  require(std::is_sorted(log->scans.begin(), log->scans.end(), earlier));
  require(std::is_sorted(log->odometry.begin(), log->odometry.end(), earlier));
  for (const auto& scan : log->scans) {
    require(std::isfinite(scan.stamp_s) && is_finite(scan.laser_odom) && is_finite(scan.robot_odom));
    require(!scan.range_m.empty() && scan.range_m.size() <= types::Scan::kMaxBeams);
    require(std::isfinite(scan.angle_min_rad) && std::isfinite(scan.angle_increment_rad));
    for (const float r : scan.range_m) require(!(r < 0.0F) || r == types::kTooNear);
  }
  for (const auto& odometry : log->odometry) {
    require(std::isfinite(odometry.stamp_s) && is_finite(odometry.pose));
    require(std::isfinite(odometry.v_mps) && std::isfinite(odometry.omega_radps));
  }
}

void check_relations(const std::string& path) {
  const auto relations = bench::read_relations(path);
  if (!relations) {
    require(relations.error().message.starts_with(path));
    return;
  }
  require(!relations->empty());
  std::vector<bench::TimedPose> trajectory{{0.0, {}}, {relations->front().t1_s, {1.0, 2.0, 0.5}}};
  if (trajectory[1].stamp_s < trajectory[0].stamp_s) std::swap(trajectory[0], trajectory[1]);
  const auto errors = bench::evaluate_relations(*relations, trajectory);
  require(errors.used + errors.skipped == static_cast<int>(relations->size()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file(std::as_bytes(std::span(data, size)));
  const std::string path = file.path();
  check_log(bench::read_carmen_log(path), path);
  bench::LogOptions options;
  options.beams = bench::BeamAngles{-1.0, 0.01};  // so that sweeps of a few beams are read too
  check_log(bench::read_carmen_log(path, options), path);
  check_log(bench::read_mines_log(path), path);
  check_relations(path);
  return 0;
}

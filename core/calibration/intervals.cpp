// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/intervals.hpp"

#include <algorithm>

namespace topo::calibration {
namespace {

bool counts(const ScanPose& pose, const IntervalParams& params) {
  return pose.matched && !pose.degenerate && pose.response >= params.response_min;
}

}  // namespace

std::vector<Interval> make_intervals(std::span<const ScanPose> poses, const IntervalParams& params) {
  std::vector<Interval> intervals;
  double next_s = poses.empty() ? 0.0 : poses.front().stamp_s;
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < poses.size(); ++begin) {
    if (poses[begin].stamp_s < next_s || !counts(poses[begin], params)) continue;
    end = std::max(end, begin);
    while (end < poses.size() && poses[end].stamp_s < poses[begin].stamp_s + params.length_s) ++end;
    if (end == poses.size()) break;
    next_s = poses[begin].stamp_s + params.stride_s;
    // A scan that was lost in between may have moved the map.
    const bool whole = std::all_of(poses.begin() + static_cast<std::ptrdiff_t>(begin),
                                   poses.begin() + static_cast<std::ptrdiff_t>(end) + 1,
                                   [](const ScanPose& p) { return p.matched; });
    if (!whole || !counts(poses[end], params)) continue;
    intervals.push_back({poses[begin].stamp_s, poses[end].stamp_s,
                         poses[begin].T_map_laser.inverse() * poses[end].T_map_laser});
  }
  return intervals;
}

}  // namespace topo::calibration

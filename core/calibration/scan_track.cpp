// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/scan_track.hpp"

#include <optional>

#include "core/slam/mapper.hpp"

namespace topo::calibration {
namespace {

/// Path of the scanner by the wheels, on the scanner's clock.
struct LaserPath {
  BasePath base;
  const RobotNumbers& numbers;
  [[nodiscard]] std::optional<types::Se2> at(double stamp_s) const {
    const auto T_odom_base = base.at(stamp_s + numbers.delay_s);
    if (!T_odom_base) return std::nullopt;
    return *T_odom_base * numbers.T_base_laser;
  }
};

}  // namespace

std::vector<ScanPose> track_scans(const DriveLog& drive, const WheelTrack& wheels,
                                  const RobotNumbers& numbers, const slam::MapperParams& params) {
  const LaserPath path{BasePath(wheels, numbers.wheels), numbers};
  slam::Mapper mapper(params);
  walls::ColumnCollector none(walls::CoronalMount{}, params.columns);
  slam::Cloud cloud;
  std::vector<ScanPose> poses;
  for (const types::Scan& scan : drive.front()) {
    const double first_s = types::to_seconds(scan.first_beam);
    const double sweep_s = static_cast<double>(scan.geometry.time_increment_s) * (scan.beams - 1.0);
    const double middle_s = first_s + 0.5 * sweep_s;
    const auto first = path.at(first_s), middle = path.at(middle_s), last = path.at(first_s + sweep_s);
    if (!first || !middle || !last) continue;
    const types::Se2 back = middle->inverse();
    slam::make_cloud(scan, types::Se2{}, {back * *first, back * *last}, params.cloud, cloud);
    cloud.stamp = types::stamp_from_seconds(middle_s);
    const slam::MatchReport report = mapper.add(cloud, *middle, none);
    poses.push_back({middle_s, report.T_map_base, report.match.response, report.matched,
                     report.matched && report.match.degenerate});
  }
  return poses;
}

}  // namespace topo::calibration

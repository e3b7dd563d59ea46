// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::calibration {

/// What a scanner sees while nothing moves: one distance a beam, from several scans.
struct StillPicture {
  double angle_min_rad = 0.0, angle_increment_rad = 0.0;
  std::vector<float> range_m;  ///< median of the hits; types::kNoReturn where most scans have none

  [[nodiscard]] double angle_rad(std::size_t beam) const {
    return angle_min_rad + static_cast<double>(beam) * angle_increment_rad;
  }
  [[nodiscard]] types::Vector2 point_m(std::size_t beam) const {
    const double r = static_cast<double>(range_m[beam]);
    return {r * std::cos(angle_rad(beam)), r * std::sin(angle_rad(beam))};
  }
};

/// Makes a picture of scans that come one by one. A scan with other beams than the first begins anew.
class PictureTaker {
 public:
  void add(const types::Scan& scan);
  void clear() { scans_.clear(); }
  [[nodiscard]] std::size_t scans() const { return scans_.size(); }
  [[nodiscard]] StillPicture picture() const;

 private:
  types::ScanGeometry geometry_;
  std::vector<std::vector<float>> scans_;
};

}  // namespace topo::calibration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/still_picture.hpp"

#include <algorithm>

namespace topo::calibration {

void PictureTaker::add(const types::Scan& scan) {
  const auto ranges = scan.ranges();
  if (!scans_.empty() && (scans_.front().size() != ranges.size() || geometry_ != scan.geometry)) clear();
  geometry_ = scan.geometry;
  scans_.emplace_back(ranges.begin(), ranges.end());
}

StillPicture PictureTaker::picture() const {
  StillPicture out;
  if (scans_.empty()) return out;
  out.angle_min_rad = static_cast<double>(geometry_.angle_min_rad);
  out.angle_increment_rad = static_cast<double>(geometry_.angle_increment_rad);
  std::vector<float> hits;
  for (std::size_t beam = 0; beam < scans_.front().size(); ++beam) {
    hits.clear();
    for (const auto& scan : scans_)
      if (types::is_hit(scan[beam])) hits.push_back(scan[beam]);
    if (2 * hits.size() < scans_.size() || hits.empty()) {
      out.range_m.push_back(types::kNoReturn);
      continue;
    }
    const auto middle = hits.begin() + static_cast<std::ptrdiff_t>(hits.size() / 2);
    std::nth_element(hits.begin(), middle, hits.end());
    out.range_m.push_back(*middle);
  }
  return out;
}

}  // namespace topo::calibration

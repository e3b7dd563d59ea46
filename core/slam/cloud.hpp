// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/params.hpp"
#include "core/slam/surfel.hpp"
#include "core/types/scan.hpp"

namespace topo::slam {

/// A deskewed scan in base_link at one stamp.
struct Cloud {
  types::Stamp stamp{};
  Point sensor = Point::Zero();  ///< the laser in base_link
  std::vector<Point> points;     ///< hits, in beam order
  std::vector<float> spacing_m;  ///< distance between neighbouring beams at each hit's range
  double invalid_share = 0.0;    ///< share of the scan's beams without information
};

/// Share of a scan's beams that carry no information; 0 for a scan without beams.
double invalid_share(const types::Scan& scan);

/// Motion of base_link during the sweep: its pose relative to the pose at `stamp`, at the first and the last
/// beam. Poses in between are interpolated.
struct SweepMotion {
  types::Se2 T_ref_first;
  types::Se2 T_ref_last;
};

/// The scan's hits in base_link at the reference stamp. Leaves out invalid, too near, too far and missing
/// returns, and mixed pixels. `cloud` is reused: nothing is allocated once its vectors have grown.
void make_cloud(const types::Scan& scan, const types::Se2& T_base_laser, const SweepMotion& motion,
                const CloudParams& params, Cloud& cloud);

/// Points for matching: one per `match_spacing_m` of beam sweep at the measured range, at most
/// `match_points_max`, evenly distributed.
void select_points(const Cloud& cloud, const CloudParams& params, std::vector<Point>& out);

/// Surfels of a keyframe: line fit over each point's neighbours along the beam order, thinned like the points
/// for matching.
std::vector<Surfel> make_surfels(const Cloud& cloud, const CloudParams& params);

}  // namespace topo::slam

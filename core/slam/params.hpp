// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/transform.hpp"
#include "core/walls/coronal_mount.hpp"

namespace topo::slam {

/// Uncertainty of odometry between two scans, as standard deviations (Thrun et al., Probabilistic Robotics,
/// section 5.4, with independent translation and rotation).
struct MotionNoise {
  double trans_per_m = 0.10;  ///< along and across the motion
  double trans_floor_m = 0.03;
  double rot_per_rad = 0.10;
  double rot_per_m_rad = 0.04;
  double rot_floor_rad = 0.02;
  double speed_max_mps = 3.0;  ///< a greater speed means that odometry was reset,
  double jump_min_m = 1.0;     ///< if the jump also exceeds this: stamps are not exact
};

/// Scan to cloud: selection of points.
struct CloudParams {
  double range_max_m = 30.0;      ///< longer beams are ignored
  double match_spacing_m = 0.04;  ///< sweep of the beam between two points used for matching
  int match_points_max = 400;
  double normal_radius_m = 0.25;  ///< neighbourhood of a surfel's line fit
  double break_factor = 3.0;  ///< neighbours further apart than this many beam spacings are not one surface
  double break_floor_m = 0.20;
  double mixed_jump_m = 0.10;  ///< a single reading this far from the surfaces before and behind is mixed
};

/// Iterated closest point-to-line refinement.
struct RefineParams {
  int iterations_max = 12;
  double reach_m = 0.35;        ///< a surfel further away is no correspondence
  double kernel_m = 0.06;       ///< Cauchy scale of a residual
  double point_sigma_m = 0.03;  ///< standard deviation of a residual for the information matrix
  double inlier_m = 0.10;       ///< residual limit of an inlier, for the response
  double converged_m = 2e-4;
  double converged_rad = 1e-4;
  double degenerate_ratio = 0.02;  ///< minimum ratio of least to greatest translational information
};

/// Correlative search (Olson 2009) as branch and bound over a max pyramid (Hess et al. 2016).
struct SearchParams {
  double cell_m = 0.05;
  double kernel_sigma_m = 0.10;
  int points_max = 120;  ///< every n-th point, n rounded down: fewer than twice as many
  int depth = 5;         ///< the coarsest node is 2^depth cells wide
};

struct TrackParams {
  double response_good = 0.75;  ///< minimum fit of a refinement that is accepted without a search
  double response_lost = 0.35;  ///< minimum response; below it the match is dropped and odometry is used
  double search_sigmas = 4.0;   ///< half width of the search in prior standard deviations
  double search_floor_m = 0.30;
  double search_floor_rad = 0.25;
  double search_max_m = 3.0;  ///< limits of the search after a long time without a match: bound its cost
  double search_max_rad = 1.2;
  double search_ways = 2.0;         ///< possible odometry error relative to the distance since the last scan
  double turned_m = 0.6;            ///< half width of the search over all headings for a lost robot
  double turned_response = 0.60;    ///< minimum response of its result,
  double turned_peak_ratio = 0.90;  ///< maximum score of the second peak relative to the best,
  double turned_contradiction_min = 0.05;  ///< and minimum share of the scan that contradicts odometry
};

struct KeyframeParams {
  double travel_m = 0.40;
  double turn_rad = 0.35;
  double window_travel_m = 8.0;  ///< path length of the keyframes that tracking matches against
  int window_min = 6;
  /// This many keyframes of the window that are this near and turned this little suffice: a robot that turns
  /// on the spot for minutes adds no further keyframes, nor closures between them.
  int alike_max = 3;
  double alike_m = 0.10;
  double alike_rad = 0.10;
  /// When the share of invalid beams falls by this much since the last keyframe, a new keyframe is due even
  /// for a standing robot: a team-mate that blocked the view then has gone.
  double unveiled_share = 0.03;
};

struct LoopParams {
  double radius_m = 6.0;      ///< old keyframes within this distance plus the drift are candidates
  double drift_per_m = 0.02;  ///< growth of the uncertainty along the graph
  double drift_per_m_rad = 0.003;
  double search_floor_m = 0.30;
  double search_max_m = 6.0;
  double search_floor_rad = 0.10;
  double search_max_rad = 0.60;
  double chain_gap_m = 12.0;         ///< path length from which a keyframe belongs to "another visit"
  int group_half = 8;                ///< keyframes on either side of the nearest one in a group
  int groups_max = 2;                ///< groups per keyframe, separately for the own path and team-mates
  double response_min = 0.60;        ///< narrow search
  double response_min_wide = 0.70;   ///< search wider than 1 m
  double peak_ratio_max = 0.80;      ///< second peak relative to the best; above it the place is ambiguous
  double overlap_min = 0.45;         ///< share of points with a surfel in reach
  double response_unopposed = 0.45;  ///< minimum response where drift has accumulated and nothing contradicts
  double fit_unopposed = 0.80;       ///< in that case: minimum share that fits of the points with a surfel,
  double contradiction_max = 0.02;   ///< and maximum share of all points on ground that was seen to be free,
  int contradicting_points = 2;      ///< or this many points: in a small scan a stray one is a large share
};

struct GraphParams {
  int iterations_max = 12;
  double converged = 1e-5;          ///< the iteration ends at a smaller step, in metres and radians
  double loop_kernel = 3.0;         ///< Cauchy scale of a closure, in standard deviations
  double contradicted_chi2 = 30.0;  ///< squared error beyond which a closure is considered false
  double odometry_trans_floor_m = 0.03;
  double odometry_rot_floor_rad = 0.003;
  double loop_trans_floor_m = 0.03;
  double loop_rot_floor_rad = 0.008;
};

struct GridParams {
  double resolution_m = 0.05;
  double redo_m = 0.02;  ///< a keyframe that moved less is not redrawn by MapBuilder::prepare
  double redo_rad = 0.002;
};

struct MapperParams {
  types::Se2 T_base_laser;  ///< front laser
  walls::CoronalMount coronal;
  double odometry_wait_s = 0.15;  ///< time that a scan waits for later odometry
  MotionNoise motion;
  CloudParams cloud;
  RefineParams refine;
  SearchParams search;
  TrackParams track;
  KeyframeParams keyframe;
  LoopParams loop;
  GraphParams graph;
  GridParams grid;
};

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/transform.hpp"
#include "core/walls/coronal_mount.hpp"

namespace topo::slam {

/// How far odometry is believed between two scans, as standard deviations (Thrun et al., Probabilistic
/// Robotics, section 5.4, with independent translation and rotation).
struct MotionNoise {
  double trans_per_m = 0.10;  ///< along and across the motion
  double trans_floor_m = 0.03;
  double rot_per_rad = 0.10;
  double rot_per_m_rad = 0.04;
  double rot_floor_rad = 0.02;
  double speed_max_mps = 3.0;  ///< what says more is odometry that was set to something else,
  double jump_min_m = 1.0;     ///< when it is more than this as well: stamps are not exact
};

/// Scan to cloud: what of a scan is used.
struct CloudParams {
  double range_max_m = 30.0;      ///< beams beyond are no evidence
  double match_spacing_m = 0.04;  ///< sweep of the beam between two points used for matching
  int match_points_max = 400;
  double normal_radius_m = 0.25;  ///< neighbourhood of a surfel's line fit
  double break_factor = 3.0;  ///< neighbours further apart than this many beam spacings are not one surface
  double break_floor_m = 0.20;
  double mixed_jump_m = 0.10;  ///< a lone reading so far behind one surface and before another is on neither
};

/// Iterated closest point-to-line refinement.
struct RefineParams {
  int iterations_max = 12;
  double reach_m = 0.35;        ///< a surfel further away is no correspondence
  double kernel_m = 0.06;       ///< Cauchy scale of a residual
  double point_sigma_m = 0.03;  ///< what one residual is worth in the information matrix
  double inlier_m = 0.10;       ///< residual that counts for the response
  double converged_m = 2e-4;
  double converged_rad = 1e-4;
  double degenerate_ratio = 0.02;  ///< least to greatest translational information
};

/// Correlative search (Olson 2009) as branch and bound over a max pyramid (Hess et al. 2016).
struct SearchParams {
  double cell_m = 0.05;
  double kernel_sigma_m = 0.10;
  int points_max = 120;  ///< every n-th point, n rounded down: fewer than twice as many
  int depth = 5;         ///< coarsest node is 2^depth cells wide
};

struct TrackParams {
  double response_good = 0.75;  ///< refinement from the prior alone is believed above this
  double response_lost = 0.35;  ///< below: the match is dropped and odometry is followed
  double search_sigmas = 4.0;   ///< half width of the search in prior standard deviations
  double search_floor_m = 0.30;
  double search_floor_rad = 0.25;
  double search_max_m = 3.0;  ///< however long nothing was seen: a search takes a time that is bounded
  double search_max_rad = 1.2;
  double search_ways = 2.0;         ///< so many times the way since the last scan may odometry be wrong
  double turned_m = 0.6;            ///< half width of the search over all headings for a robot that is lost
  double turned_response = 0.60;    ///< what it finds is believed from here on,
  double turned_peak_ratio = 0.90;  ///< when the next best place is no better than this share of it
  double turned_contradiction_min = 0.05;  ///< and so much of the scan denies the heading that was heard
};

struct KeyframeParams {
  double travel_m = 0.40;
  double turn_rad = 0.35;
  double window_travel_m = 8.0;  ///< path length of the keyframes that tracking matches against
  int window_min = 6;
  /// Among these so many as near and turned as little tell all: a robot that turns on the spot for minutes
  /// makes no more of them, nor of the closures between them.
  int alike_max = 3;
  double alike_m = 0.10;
  double alike_rad = 0.10;
  /// Of a standing robot's beams: who saw so many less at the last keyframe, since a team-mate stood before
  /// it, looks again when that one is gone.
  double unveiled_share = 0.03;
};

struct LoopParams {
  double radius_m = 6.0;      ///< old keyframes this near are candidates, plus the drift
  double drift_per_m = 0.02;  ///< growth of the uncertainty along the graph
  double drift_per_m_rad = 0.003;
  double search_floor_m = 0.30;
  double search_max_m = 6.0;
  double search_floor_rad = 0.10;
  double search_max_rad = 0.60;
  double chain_gap_m = 12.0;         ///< graph distance from which a keyframe is "another visit"
  int group_half = 8;                ///< keyframes on either side of the nearest one in a group
  int groups_max = 2;                ///< chains tried per keyframe
  double response_min = 0.60;        ///< narrow search
  double response_min_wide = 0.70;   ///< search wider than 1 m
  double peak_ratio_max = 0.80;      ///< second peak against the best: above it the place is ambiguous
  double overlap_min = 0.45;         ///< share of points with a surfel in reach
  double response_unopposed = 0.45;  ///< enough where drift has gathered and nothing speaks against the place
  double fit_unopposed = 0.80;       ///< nothing: of what the other visit knows at least this share fits,
  double contradiction_max = 0.02;   ///< and of all points at most this stand where it looked through,
  int contradicting_points = 2;      ///< or so many: of a small scan a stray one is a large share
};

struct GraphParams {
  int iterations_max = 12;
  double converged = 1e-5;          ///< a step smaller than this, in metres and radians, is the last
  double loop_kernel = 3.0;         ///< Cauchy scale of a closure, in standard deviations
  double contradicted_chi2 = 30.0;  ///< squared error beyond which a closure is held to be false
  double odometry_trans_floor_m = 0.03;
  double odometry_rot_floor_rad = 0.003;
  double loop_trans_floor_m = 0.03;
  double loop_rot_floor_rad = 0.008;
};

struct GridParams {
  double resolution_m = 0.05;
  double redo_m = 0.02;  ///< a keyframe that moved less is not drawn again
  double redo_rad = 0.002;
};

struct MapperParams {
  types::Se2 T_base_laser;  ///< front laser
  walls::CoronalMount coronal;
  double odometry_wait_s = 0.15;  ///< how long a scan waits for the odometry after it
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

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "core/types/transform.hpp"
#include "core/walls/column_params.hpp"
#include "core/walls/coronal_mount.hpp"

// Parameters of mapping: one set for all robots and buildings. A value that names no source was chosen
// while the logs of doc/results.md, section "Mapping", were at hand.
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
  /// The motion between the two scans before, continued, has this multiple of the standard deviations above.
  double continued_sigmas = 3.0;
};

/// Scan to cloud: selection of points.
struct CloudParams {
  double range_max_m = 30.0;      ///< longer beams are ignored
  double match_spacing_m = 0.04;  ///< sweep of the beam between two points used for matching
  int match_points_max = 400;
  double normal_radius_m = 0.25;  ///< neighbourhood of a surfel's line fit
  double break_factor = 3.0;  ///< neighbours further apart than this many beam spacings are not one surface
  double break_floor_m = 0.20;
  double mixed_jump_m = 0.10;  ///< a single reading this far from the surfaces before and behind is mixed,
  double mixed_ratio = 0.5;    ///< if the next jump on either side is smaller than this share of it
  std::size_t neighbours_min = 3;  ///< of a surfel on either side, whatever the distance between the beams
  double flat_ratio = 0.2;         ///< greatest ratio of the scatter across to the scatter along a line
  double grazing_sin = 0.15;       ///< sine of the angle to a surface below which the noise is not observable
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
  double point_weight = 0.25;  ///< of a surfel without a line, in each direction, relative to one on a line
};

/// Correlative search (Olson 2009) as branch and bound over a max pyramid (Hess et al. 2016).
struct SearchParams {
  double cell_m = 0.05;
  double kernel_sigma_m = 0.10;
  int points_max = 120;               ///< every n-th point, n rounded down: fewer than twice as many
  int depth = 5;                      ///< the coarsest node is 2^depth cells wide
  double kernel_sigmas = 2.5;         ///< half width of a surfel's likelihood, in kernel_sigma_m
  double angle_reach_m = 10.0;        ///< an angle step moves a point at this range, or nearer, by one cell,
  double angle_step_min_rad = 0.004;  ///< and is at least this: about a beam of a UTM-30LX
};

/// Search for the place of a scan that odometry does not explain: of a robot that was turned by hand, or
/// whose wheels slipped.
struct TurnedParams {
  double half_width_m = 0.6;         ///< of the search over all headings for a lost robot
  double score_min = 0.35;           ///< minimum likelihood of a pose that is refined
  double response_min = 0.60;        ///< minimum response of the result
  double apart_rad = 0.3;            ///< nearer headings are one peak
  double peak_ratio = 0.90;          ///< maximum score of the second peak relative to the best
  double contradiction_min = 0.05;   ///< minimum share of the scan that contradicts odometry,
  double contradiction_ratio = 2.0;  ///< and least ratio of it to the share that contradicts the result
};

struct TrackParams {
  double response_good = 0.75;  ///< minimum fit of a refinement that is accepted without a search
  double response_lost = 0.35;  ///< minimum response; below it the match is dropped and odometry is used
  /// The same for a pose that a search found and that the scan contradicts clearly less than odometry's: most
  /// of a scan may show what nothing has shown before.
  double response_explained = 0.25;
  double likely_sigmas =
      3.0;  ///< a pose found this near to odometry's, in standard deviations, needs no more
  double search_sigmas = 4.0;  ///< half width of the search in prior standard deviations
  double search_floor_m = 0.30;
  double search_floor_rad = 0.25;
  double search_max_m = 3.0;  ///< limits of the search after a long time without a match: bound its cost
  double search_max_rad = 1.2;
  double search_ways = 2.0;        ///< possible odometry error relative to the distance since the last scan
  double search_score_min = 0.2;   ///< minimum likelihood of a pose near the prior that is refined
  double search_better_by = 0.05;  ///< by this response a pose found must exceed that of the refinement
  TurnedParams turned;
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
  double window_overfull = 2.0;  ///< the window is built anew at this multiple of the keyframes on its path
  double half_width_m = 32.0;    ///< of the map for tracking: beyond the reach of a UTM-30LX, 30 m
  double recentre_m = 6.0;       ///< the map is built anew when the robot is this far from its centre
  double resumed_m = 10.0;       ///< after a resumption, old keyframes this near help to track at first
};

/// Ground that the rays of keyframes crossed (free_ground.hpp).
struct FreeGroundParams {
  float cell_m = 0.15F;
  float short_m = 0.40F;       ///< before its end a ray grazes the surface
  float near_m = 0.20F;        ///< a surface within this distance explains a point
  int rays_min = 3;            ///< fewer rays may be noise
  std::size_t ray_stride = 2;  ///< every n-th ray is used: neighbouring rays cross the same ground
};

/// Search and refinement of one candidate for a closure.
struct LoopMatchParams {
  double search_from_m = 0.6;  ///< window from which on a plain refinement could reach a wrong local minimum
  double score_min = 0.35;     ///< minimum likelihood of the best pose of the search
  double apart_m = 0.6;        ///< nearer poses are one peak
  double apart_rad = 0.3;
  double reach_max_m = 20.0;    ///< of the scan: bounds the map that it is matched with
  double margin_m = 1.0;        ///< of that map around reach and window
  double diverged_ratio = 1.5;  ///< a refinement further away than this multiple of the window,
  double diverged_m = 0.3;      ///< plus this, has diverged
};

/// Acceptance of a closure.
struct LoopGateParams {
  double response_min = 0.60;        ///< narrow search
  double response_min_wide = 0.70;   ///< search wider than
  double wide_m = 1.0;               ///< this
  double peak_ratio_max = 0.80;      ///< second peak relative to the best; above it the place is ambiguous
  double overlap_min = 0.45;         ///< share of points with a surfel in reach
  double response_unopposed = 0.45;  ///< minimum response where drift has accumulated and nothing contradicts
  double fit_unopposed = 0.80;       ///< in that case: minimum share that fits of the points with a surfel,
  double contradiction_max = 0.02;   ///< and maximum share of all points on ground that was seen to be free,
  int contradicting_points = 2;      ///< or this many points: in a small scan a stray one is a large share
};

struct LoopParams {
  double radius_m = 6.0;      ///< old keyframes within this distance plus the drift are candidates
  double drift_per_m = 0.02;  ///< growth of the uncertainty along the graph
  double drift_per_m_rad = 0.003;
  double search_floor_m = 0.30;
  double search_max_m = 6.0;
  double search_floor_rad = 0.10;
  double search_max_rad = 0.60;
  double chain_gap_m = 12.0;   ///< path length from which a keyframe belongs to "another visit"
  int group_half = 8;          ///< keyframes on either side of the nearest one in a group
  int groups_max = 2;          ///< groups per keyframe, separately for the own path and team-mates
  std::size_t run_gap = 3;     ///< keyframes between two that are near, at most, in one group
  std::size_t tied_reach = 3;  ///< on a team-mate's path, keyframes on either side of a tied one are tied
  LoopMatchParams match;
  LoopGateParams gate;
};

/// When odometry is held against a match between two keyframes (odometry_evidence.hpp).
struct OdometryEvidenceParams {
  MotionNoise noise;
  /// Squared whitened distance between both from which they contradict each other: four standard deviations.
  double doubted_chi2 = 16.0;
};

/// What the walls of a keyframe say of its heading (heading_evidence.hpp).
struct HeadingEvidenceParams {
  double near_rad = 0.0524;     ///< 3 degrees: walls that differ less have one direction
  double share_min = 0.6;       ///< of the keyframes with walls, that have the direction of a wing
  double wing_share_min = 0.1;  ///< the same, of one wing
  /// 5 degrees: walls further off say nothing, they may belong to a skew wing. Wings are twice as far apart:
  /// core/analysis/wings.hpp finds them from 10 degrees on.
  double wing_rad = 0.0873;
  /// Of a keyframe's heading by its walls. They are more exact, but all of a building may be askew alike, and
  /// a wall counts in each keyframe that sees it. 2 degrees were tried, too (doc/results.md).
  double sigma_rad = 0.0175;
};

struct GraphParams {
  int iterations_max = 12;
  double converged = 1e-5;  ///< the iteration ends at a smaller step, in metres and radians
  /// Cauchy scale of a closure, and of a match that odometry contradicts, in standard deviations. For such a
  /// match 1 was tried, too: MIT CSAIL, whose odometry comes late, overruled three good ones
  /// (doc/results.md).
  double loop_kernel = 3.0;
  double contradicted_chi2 = 30.0;  ///< squared error beyond which a closure is considered false
  OdometryEvidenceParams odometry{};
  HeadingEvidenceParams heading{};
  double odometry_trans_floor_m = 0.03;
  double odometry_rot_floor_rad = 0.003;
  double loop_trans_floor_m = 0.03;
  double loop_rot_floor_rad = 0.008;
  double match_sigma_floors = 2.0;  ///< an edge as certain as this multiple of loop_trans_floor_m is a match
  int closures_before_solve = 10;   ///< closures that agree with the graph wait for so many,
  std::size_t keyframes_before_solve = 25;  ///< whose walls wait (heading_evidence.hpp): some 10 m,
  double tension_chi2 = 1.0;                ///< while one with a greater squared error is solved for at once
  /// An edge with a greater standard deviation of its rotation is loose: what lies before it is searched for
  /// closures as another visit is. MotionNoise gives it to a robot that stands; matches are several times as
  /// certain.
  double loose_rad = 0.02;
  double loose_m = 0.15;         ///< the same of its position; matches are certain to 0.03 m
  double turn_on_spot_m = 0.05;  ///< added to the length of an edge: drift grows in turns on the spot, too
};

/// When the map of a team-mate that nothing ties to this one is searched in it (team_alignment.hpp).
struct TeamMapParams {
  std::size_t keyframes_min = 50;  ///< of the team-mate: fewer have no places that agree
  double growth = 1.2;             ///< of both maps together, before they are searched again
};

/// When the newest stretch of the own path is searched in all that was mapped before (own_past.hpp).
struct OwnPastParams {
  std::size_t window = 66;    ///< keyframes of the stretch: six patches (team_alignment.hpp)
  std::size_t every = 33;     ///< keyframes between two searches: some 13 m
  std::size_t past_min = 50;  ///< fewer keyframes before it have no places that agree
  int agreeing_min = 3;       ///< patches that must agree, each without a rival
  double sigmas = 3.0;        ///< standard deviations that the estimate may be off
};

struct GridParams {
  double resolution_m = 0.05;
  double redo_m = 0.02;  ///< a keyframe that moved less is not redrawn by MapBuilder::prepare
  double redo_rad = 0.002;
};

struct MapperParams {
  types::Se2 T_base_laser;  ///< front laser
  walls::CoronalMount coronal;
  walls::ColumnParams columns;
  double odometry_wait_s = 0.15;  ///< time that a scan waits for later odometry
  MotionNoise motion;
  CloudParams cloud;
  RefineParams refine;
  SearchParams search;
  TrackParams track;
  KeyframeParams keyframe;
  LoopParams loop;
  GraphParams graph;
  FreeGroundParams free_ground;
  TeamMapParams team;
  OwnPastParams past;
  GridParams grid;
};

}  // namespace topo::slam

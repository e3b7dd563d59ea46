// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>

#include "core/types/stamp.hpp"

// Parameters of core/motion. Where a value names no other source, it is a choice that the simulated scenes of
// the unit tests (tests/unit/core/motion) and the explorations in doc/results.md hold. What the base may do
// is in types::RobotLimits.
namespace topo::motion {

/// Moving obstacles (giving_way.hpp).
struct GivingWayParams {
  double braking_share = 0.8;  ///< of the deceleration: later periods must be able to keep to it as well
  double unsure_mps = 0.1;     ///< uncertainty of a velocity, and of a person's next motion
  double clear_for_s = 1.0;    ///< after it has come to rest, or while it drives on
  double nearer_m = 0.01;      ///< an obstacle within the margin counts when it comes nearer by this
};

/// How old a front scan may be, by its arrival: the longer of a time and so many of its periods (DESIGN
/// "Threads").
struct ScanAgeParams {
  types::Duration age_max = std::chrono::milliseconds(150);
  double periods = 2.5;
  double period_max_s = 0.2;  ///< longer than any scanner's: a wrong period must not extend the limit
};

/// The velocity gate (velocity_gate.hpp; DESIGN "Motion and safety").
struct GateParams {
  ScanAgeParams scan;
  double valid_share_min = 0.5;  ///< of the forward beams: less is a blind scanner
  double elapsed_max_s = 0.1;    ///< two periods: a late one must not cause a jump in speed
  double standstill_mps = 0.01;  ///< slower counts as standing
  double standstill_radps = 0.02;
  double unnoticed_slip_s = 1.0;  ///< until a match against the map shows that a wheel slipped in a turn
  double late_share = 0.8;  ///< of the speed from which normal braking suffices: above, the firmware's E_STOP
  double late_from_mps = 0.1;  ///< slower, a normal stop is as short
  /// Bound of a scan's age in alive_time_s(), by the first beam: older is a wrong stamp.
  types::Duration first_beam_age_max = std::chrono::seconds(1);
  GivingWayParams giving_way;
};

/// The last metre that the robot drove (breadcrumb_path.hpp).
struct BreadcrumbParams {
  double length_m = 1.0;     ///< twice BackingParams::most_m
  double spacing_m = 0.02;   ///< of its points; the array holds length_m with this one
  double behind_rad = 0.35;  ///< farther aside than this, the path is not behind the robot
  double beside_m = 0.03;    ///< points nearer to the robot's axis are behind it whatever their bearing
  double jump_m = 0.25;      ///< between two poses: the odometry was reset
  /// Distances of the point backed towards, the preferred first.
  std::array<double, 3> aims_m{0.2, 0.15, 0.1};
  double off_m = 0.1;  ///< from the newest point: the robot is not on the path
};

/// How an arc is compared with others: its score is its progress along the path in metres, and the weights
/// say what counts as much as one metre.
struct ArcScoreParams {
  double speed_s = 0.5;             ///< gain per m/s of its speed
  double end_off = 1.2;             ///< loss per metre between its end and the path
  double middle_off = 0.5;          ///< the same at its middle
  double heading_m_per_rad = 0.25;  ///< loss per radian between its end's heading and the path's
  double change_m2 = 0.02;          ///< loss per 1/m of change of curvature: no swaying
  double way_min_m = 0.25;          ///< length of an arc at least, at low speed
  double beyond_m = 0.3;            ///< of the path, past the arc's length, in which its end's station lies
  double pursuit_max_per_m = 4.0;   ///< curvature of the arc through the target point
  /// The fan, in 1/m. Of two equal scores the first wins.
  std::array<double, 21> curvatures_per_m{0.0, 0.1,  -0.1, 0.22, -0.22, 0.36, -0.36, 0.55, -0.55, 0.8, -0.8,
                                          1.1, -1.1, 1.5,  -1.5, 2.0,   -2.0, 2.7,   -2.7, 3.6,   -3.6};
};

/// Turns on the spot.
struct FollowerTurnParams {
  double begin_rad = 0.9;        ///< greater heading error: turn on the spot
  double end_rad = 0.2;          ///< heading error that ends the turn
  double extra_margin_m = 0.01;  ///< more than the gate keeps, for a turn that begins: noise of near ranges
  double begun_radps = 0.1;      ///< turning faster, it has begun
  double braking = 1.2;  ///< times the angular acceleration: it slows to the turn's end with 60 % of it
  /// Headings tried when the arcs of the present one are slow, and what a turn costs in the arcs' score.
  std::array<double, 6> tried_rad{0.25, -0.25, 0.5, -0.5, 0.75, -0.75};
  double stop_cost_m = 0.1, cost_m_per_rad = 0.3;
  double slow_end_m = 1.2;   ///< a slow arc ends nearer than this: farther obstacles do not matter
  double slower_mps = 0.01;  ///< than slow_mps or the cap, by this: try headings
};

/// The end of a path.
struct ArrivalParams {
  double along_m = 0.04;      ///< rest of the path at which the robot has arrived
  double off_factor = 3.0;    ///< times along_m: from the end, when so little of the path is left
  double passed_m = 0.25;     ///< an end this near and behind the robot was passed
  double braking = 1.2;       ///< times the deceleration: it slows to the end with 60 % of it
  double slowest_mps = 0.06;  ///< this fast at least until it arrives
};

/// Path following (path_follower.hpp).
struct FollowerRules {
  double lookahead_m = 0.5;      ///< distance along the path of the target point
  double horizon_s = 1.5;        ///< arcs are compared at this time
  double extra_margin_m = 0.04;  ///< more than the gate keeps free, so that noise does not make it brake
  double omega_max_radps = 1.0;  ///< while driving
  double crawl_mps = 0.05;       ///< an arc that allows less counts as blocked
  double slow_mps = 0.3;         ///< an arc that allows less is tried without extra_margin_m
  double blind_slack =
      1.05;  ///< times the gate's blind time: slower than it allows, so that it need not brake
  double behind_m = 0.3, ahead_m = 1.5;  ///< range of the search for the robot along the path
  double tangent_m = 0.15;               ///< to either side: two points of the path that give its heading
  ArcScoreParams score;
  FollowerTurnParams turn;
  ArrivalParams arrival;
};

/// Backing off along the breadcrumb path.
struct BackingParams {
  double most_m = 0.5;    ///< at most, without the roll until the watchdog fires (DESIGN "Motion and safety")
  double slack_m = 0.05;  ///< less than most_m by this is enough
  double enough_m = 0.2;  ///< times the number of the try: the shortest distance that changes the view ahead
  double begun_m = 0.05;  ///< after this, it no longer turns the path behind itself
  /// The tail of a P3-DX swings 2 cm aside: less than the margin kept on the way in.
  double straight_rad = 0.1;
  double creep_mps = 0.03;  ///< slower: the path is used up
};

/// Easing straight back over seen ground.
struct EasingParams {
  double step_m = 0.08;     ///< times the number of the try
  double speed_mps = 0.05;  ///< at most
  double least_mps = 0.02;  ///< slower: the seen ground is used up
  /// Length of seen ground that is measured: more than the robot rolls on when the host fails while it eases.
  double seen_max_m = 0.15;
};

/// Recovery from a blocked path (recovery.hpp).
struct RecoveryRules {
  types::Duration blink = std::chrono::milliseconds(300);    ///< blocked for less is noise
  types::Duration wait = std::chrono::milliseconds(2500);    ///< for an obstacle that leaves by itself
  types::Duration refused = std::chrono::milliseconds(700);  ///< then a motion is given up
  types::Duration phase_max = std::chrono::seconds(8);
  types::Duration try_max = std::chrono::seconds(24);     ///< three phases; the rest of it is for kLeaving
  types::Duration no_progress = std::chrono::seconds(8);  ///< counts as blocked
  double progress_m = 0.15;
  double leave_m = 0.4;          ///< straight ahead, at most
  double room_ahead_m = 0.25;    ///< less is used up soon, with the robot nearer to the obstacle
  double aligned_rad = 0.25;     ///< heading error that ends a turn
  double omega_max_radps = 0.8;  ///< of turns
  int tries = 3;                 ///< then stuck
  double forgotten_m = 1.0;      ///< distance from the first try at which the tries begin anew
  BackingParams back;
  EasingParams ease;
};

/// Waiting for moving obstacles (yielding.hpp).
struct YieldingParams {
  types::Duration patience = std::chrono::seconds(10);  ///< the other may wait as well
  types::Duration forgotten = std::chrono::seconds(3);  ///< not held up for this long: a new encounter
  /// Wait after one on the right, which has right of way.
  types::Duration go_first = std::chrono::milliseconds(1500);
};

struct MotionParams {
  GateParams gate;
  BreadcrumbParams breadcrumbs;
  FollowerRules follower;
  RecoveryRules recovery;
  YieldingParams yielding;
};

}  // namespace topo::motion

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/slam/params.hpp"

namespace topo::calibration {

/// Pieces of the drive that wheels and scans are compared over. Longer ones have less noise of matching per
/// metre, and more of them are hit by a slip: 2 s were best of 1, 2 and 4 s in the simulator.
struct IntervalParams {
  double length_s = 2.0;
  double stride_s = 0.5;      ///< between the beginnings of two
  double response_min = 0.5;  ///< of a match at either end, below which the interval does not count
};

/// Least squares over the intervals.
struct FitParams {
  int iterations = 8;               ///< of reweighting and refinement; 5 suffice
  double delay_max_s = 0.25;        ///< the delay is looked for within this,
  double delay_step_s = 0.01;       ///< first at these steps
  double outlier_sigmas = 3.5;      ///< beyond, an interval is left out: a wheel slipped
  double sigma_floor_m = 0.002;     ///< of an interval's motion by matching: never taken to be better
  double sigma_floor_rad = 0.0005;  ///< the same
};

/// A scanner that was bumped has another place in some part of the drive.
struct SteadinessParams {
  double window_s = 30.0;        ///< of the parts; each must turn and drive to count
  double sigmas = 4.0;           ///< a part differs when it is beyond this many standard deviations,
  double yaw_rad = 0.009;        ///< and beyond this (0.5 degrees),
  double place_m = 0.02;         ///< or this
  double sigma_max_rad = 0.006;  ///< parts that are known less well do not count,
  double sigma_max_m = 0.015;    ///< nor these
};

/// What the coronal scanner is held against.
struct CoronalParams {
  double gate_m = 0.25;           ///< first distance from the floor within which a return may be floor,
  double gate_rad = 0.14;         ///< plus this times the distance aside: a scanner rolled by 8 degrees
  double gate_end_m = 0.06;       ///< the last distance: two standard deviations of a range
  double floor_side_min_m = 1.0;  ///< the floor must be seen over this extent from left to right
  int floor_points_min = 500;
  double wall_height_m = 0.15;  ///< about the front scanner's height: what both scanners see
  double wall_gate_m = 0.15;    ///< between a return and the front scanner's surface
  double wall_back_s = 0.2;     ///< from a coronal scan to the front scan it is held against
  double normal_min = 0.2;      ///< share of the walls' directions across and along: else one shows only
  int wall_points_min = 300;
  int point_stride = 4;  ///< every n-th beam
  /// What more returns do not mend, in the simulator: skirtings that look like floor, furniture that the two
  /// scanners see at two heights.
  double sigma_floor_rad = 0.001, sigma_floor_m = 0.003;
};

/// What is believed. The standard deviations are a third of the accuracy that exploration wants.
struct VerdictParams {
  double drive_min_s = 60.0;     ///< of the drive: shorter ones leave no room to leave anything out
  double way_min_m = 8.0;        ///< below, the wheels' travel does not show
  double turn_min_rad = 6.3;     ///< to each side, once round: below, track and place do not show
  double matched_min = 0.9;      ///< share of the scans that were matched
  double degenerate_max = 0.25;  ///< share of the scans that leave one direction open
  double response_min = 0.5;     ///< median over the scans: people, glass, another floor
  double left_out_max = 0.35;    ///< share of the intervals that contradict the rest
  double sigma_wheel = 0.0015, sigma_track = 0.0025;  ///< of the value
  double sigma_yaw_rad = 0.0026, sigma_place_m = 0.005, sigma_delay_s = 0.003;
  double wheel_error_max = 0.2, track_error_max = 0.5;  ///< from the model: more is another model
  double delay_min_s = -0.1, delay_max_s = 0.2;
  double place_max_m = 1.0;  ///< what the configuration takes
};

struct CalibrationParams {
  slam::MapperParams mapper;   ///< its coronal mount and front laser are not used
  double scan_period_s = 0.1;  ///< scans between are left out
  int passes = 2;              ///< of matching: the second undistorts scans with what the first found
  IntervalParams interval;
  FitParams fit;
  SteadinessParams steadiness;
  CoronalParams coronal;
  VerdictParams verdict;
};

}  // namespace topo::calibration

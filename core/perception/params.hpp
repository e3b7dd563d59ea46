// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>

#include "core/types/se2.hpp"
#include "core/types/sector.hpp"
#include "core/types/stamp.hpp"

// Parameters of core/perception. Where a value names no other source, it is a choice that the simulated
// scenes of the unit tests hold (tests/unit/core/perception, tests/unit/core/motion/moving_scene.hpp).
namespace topo::perception {

/// Contact of a moving outline with points (footprint_sweep.hpp).
struct ContactParams {
  double noise_m = 0.03;  ///< of a range: the UTM-30LX's catalogue accuracy from 0.1 to 10 m
  /// Of a point's relative speed, at which the gap closes: less is a motion along it.
  double closing_share = 0.2;
};

/// An isolated hit between two surfaces at different distances (stop_zone.hpp).
struct MixedPixelParams {
  float from_m = 0.7F;        ///< nearer, three beams of 0.25 degrees hit any object of 1 cm
  double gap_m = 0.15;        ///< least distance from both neighbours
  std::size_t beams_max = 3;  ///< distance of a neighbour in beams, over invalid ones
};

/// What counts as an obstacle for the velocity gate (stop_zone.hpp).
struct StopZoneParams {
  /// To either side of straight ahead; DESIGN "Motion and safety". Within it a beam without a measurement is
  /// an obstacle. daemon/config accepts only mounts of the scanner that see all of it.
  double forward_sector_rad = 60.0 * types::kDegree_rad;
  /// A longer gap of invalid beams is an obstacle: 13 mm wide at 1 m with 0.25 degrees.
  std::size_t bridged_beams = 3;
  /// Bearings from the scanner, from straight ahead, that are not looked at: the robot's own posts. A gap
  /// there is bridged whatever its width; what stood there when the view moved on is remembered (BlindSpot).
  /// The configuration bounds them (daemon/config/masks.hpp).
  types::Sectors masks{};
  /// Range of an obstacle nearer than the scanner measures, when its stated minimum is less than this.
  float least_range_m = 0.02F;
  /// Of an echo: a sweep of the transducers takes 320 ms.
  types::Duration sonar_age_max = std::chrono::milliseconds(500);
  double on_the_spot_mps = 0.01;  ///< a slower twist is a turn on the spot; ARCOS reports whole mm/s
  MixedPixelParams mixed_pixel;
  ContactParams contact;
};

/// Ground that the scanner saw and the robot may back over (seen_ground.hpp).
struct SeenGroundParams {
  double beam_m = 0.7;          ///< of a beam: half of the square is left for the robot's earlier positions
  std::size_t beam_stride = 4;  ///< one beam of so many is used: 1.2 cm apart at beam_m with 0.25 degrees
};

/// Points beside the robot that the scanner no longer sees (blind_spot.hpp).
struct BlindSpotParams {
  double reach_m = 0.6;          ///< from the robot's centre: more than any outline with its margin
  double leaves_view_rad = 0.6;  ///< this near to the view's edge, a point may leave it before the next scan
  double spacing_m = 0.02;       ///< between kept points
  double mover_rim_m = 0.15;     ///< around a moving obstacle: a second leg beside the first
  double jump_m = 0.25;          ///< between two scans: the odometry was reset
  double jump_rad = 1.0;         ///< the same for a rotation
  types::Duration kept = std::chrono::seconds(60);  ///< DESIGN "Motion and safety"
  SeenGroundParams ground;
};

/// Match of two sweeps (look_match.hpp).
struct LookMatchParams {
  std::size_t compared = 300;  ///< beams of a sweep, at most about
  int rounds = 10;             ///< at most
  int coarse_rounds = 2;       ///< of these, with coarse_m in place of scale_m
  double coarse_m = 0.2;
  double scale_m = 0.05;           ///< residual above which a beam counts little
  double fits_m = 0.1;             ///< residual of a beam that fits (LookMatch::explained)
  double far_m = 0.5;              ///< residual without a correspondence
  double guess_m = 0.03;           ///< error of a guess that weighs as much as one residual of scale_m
  double guess_rad = 0.03;         ///< the same for the heading
  double beside_m = 0.08;          ///< to the two hits beside a beam that give the line
  double beside_beams_max = 10.0;  ///< the same, in beams
  double corner_m = 0.4;           ///< two hits farther apart are of two surfaces
};

/// Small objects in a sweep (scan_groups.hpp).
struct ScanGroupParams {
  std::size_t hits_min = 3;       ///< fewer: a mixed pixel, or too few to locate
  std::size_t bridged_beams = 3;  ///< between two hits of one surface
  /// Unevenness of a surface, and its least angle to the beams: below ten degrees it breaks up (Borges and
  /// Aldon 2004).
  double uneven_m = 0.09, grazing_rad = 0.17;
  /// Of the extent, along the beams: more is a piece of such a surface, which has no real end.
  double radial_share = 0.8;
  double behind_m = 0.12;    ///< farther by this much is behind
  double apart_m = 0.4;      ///< between two legs
  double across_m = 0.9;     ///< greatest extent of a group: the diagonal of a P3-AT is 0.8 m
  double range_max_m = 6.0;  ///< there a leg of 0.1 m has three hits with 0.25 degrees
  double end_m = 0.08;       ///< hits this near to the first or last one give the group's end
};

/// Which sweeps are compared (moving_obstacles.hpp).
struct SweepParams {
  types::Duration every = std::chrono::milliseconds(90);   ///< a scan each tenth of a second, with jitter
  types::Duration pause = std::chrono::milliseconds(450);  ///< longer without a sweep: begin anew
  double carried_m = 0.5;       ///< between two sweeps: more than wheels can drive within `pause`
  double explained_min = 0.85;  ///< share of beams that fit; below, the scanner's pose is unknown
};

/// How groups are followed from sweep to sweep.
struct TrackParams {
  double search_m = 0.15;    ///< around the expected place, and more with time:
  double fastest_mps = 2.0;  ///< of an obstacle of unknown velocity: a person in a hurry
  double surprise = 0.5;     ///< share of fastest_mps by which a known velocity may change
  double window_s = 0.55;    ///< age of the sightings that give the velocity: five sweeps
  std::size_t sightings_min = 3;
  double still_mps = 0.1;      ///< slower
  double still_s = 0.4;        ///< for this long: it stands
  double gone_s = 0.5;         ///< unseen for this long: it is gone
  double gone_still_s = 0.25;  ///< the same for a group that never moved
};

/// When a group begins to move.
struct BeginsToMoveParams {
  double speed_mps = 0.2, again_mps = 0.1;          ///< at least; `again`: of a group that has moved before
  double covered_m = 0.06, covered_again_m = 0.02;  ///< on top of noise: what a change of view shifts
  double noise_share = 0.01;                        ///< of the range: error of a group's centre
  double noise_beams = 1.5;                         ///< added to it: spacings of the beams at that range
  /// Greatest distance of a sighting from the straight line: this, and shares of the noise and of the
  /// distance.
  double off_m = 0.03, off_noise_share = 0.5, off_covered_share = 0.15;
  /// The sweep that saw through the place is at least so old.
  double before_s = 0.25;
  double through_m = 0.1;     ///< it saw farther by this
  double beside_m = 0.03;     ///< in all beams within this distance of a hit
  double clear_share = 0.25;  ///< of the group's hits, and
  double clear_min = 2.0;     ///< so many at least
};

struct MovingObstacleParams {
  SweepParams sweeps;
  LookMatchParams match;
  ScanGroupParams groups;
  TrackParams tracks;
  BeginsToMoveParams begins;
};

/// Which corrections of the map are drift of the odometry (steady_frame.hpp).
struct SteadyFrameParams {
  double match_noise_m = 0.02, match_noise_rad = 0.02;  ///< of a match against the map
  double half_track_m = 0.18;  ///< of the wheels: a P3-DX has a track of 357 mm (PROTOCOLS)
  double slip_share = 0.6;     ///< of a wheel's travel that is lost (as RobotLimits::slip_curvature_per_m)
};

/// Which echoes of the sonar are obstacles that the laser does not see (unseen_echoes.hpp).
struct UnseenEchoParams {
  double range_max_m = 1.2;                                  ///< the beam, of 25 degrees, is 0.5 m wide there
  double range_min_m = 0.15;                                 ///< nearer ones are ringing of the transducer
  types::Duration age_max = std::chrono::milliseconds(150);  ///< later the robot has moved on
  /// Within `age_max`, a faster turn makes an echo belong to another direction.
  double steady_radps = 0.3;
  double half_cone_rad = 0.30;    ///< the beam's 12.5 degrees and the error of the pose
  double looks_ahead_rad = 1.75;  ///< of a transducer: the laser's 135 degrees less the whole cone
  double behind_m = 0.30;         ///< a laser point up to here behind an echo explains it
};

struct PerceptionParams {
  StopZoneParams stop_zone;
  BlindSpotParams blind_spot;
  MovingObstacleParams moving;
  SteadyFrameParams steady_frame;
  UnseenEchoParams unseen_echoes;
};

}  // namespace topo::perception

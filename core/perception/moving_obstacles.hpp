// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/perception/moving_obstacle.hpp"
#include "core/perception/params.hpp"
#include "core/perception/scan_groups.hpp"
#include "core/types/base_state.hpp"

namespace topo::perception {

/// Pose of the base at `when`, from the odometry and its twist; extrapolates by at most the default of
/// RobotLimits::status_age_max.
types::Se2 pose_at(const types::Odometry& odometry, types::Stamp when);

/// Moving obstacles in the front scan: groups of hits are followed over half a second, with the robot's own
/// motion removed by a match with static surroundings (match_looks). A group moves when it has covered
/// distance on a line and is where the scanner saw through a quarter of a second ago: a location that a
/// change of view uncovers was hidden, not free (Petrovskaya and Thrun 2009). Of a group that is half hidden
/// only the free end counts. A group that has moved once is accepted sooner the next time. It stops moving
/// after standing for a while; unseen, it is extrapolated for half a second.
///
/// Groups that are slow at first (BeginsToMoveParams), large, far (ScanGroupParams) or hidden on both sides
/// count as standing. Fixed size: allocates nothing.
class MovingObstacles {
 public:
  static constexpr std::size_t kMax = 8;  ///< written: more do not fit around a robot

  explicit MovingObstacles(const MovingObstacleParams& params = {}) : params_(params) {}
  /// Processes the newest scan and odometry; uses a scan each SweepParams::every and clears all tracks after
  /// a pause or a jump of the odometry.
  void update(const types::Scan& scan, const types::Se2& T_base_laser, const types::Odometry& odometry);
  void forget();
  /// Writes the moving obstacles, nearest first, with their positions at `when` in the base frame of that
  /// time. Returns how many were written to `out`.
  std::size_t around(const types::Odometry& odometry, types::Stamp when,
                     std::span<MovingObstacle, kMax> out) const;

 private:
  /// Sizes of arrays. Sweeps: those of TrackParams::window_s. Tracks and groups beyond are left out.
  static constexpr std::size_t kLooks = 6, kTracks = 32, kGroups = 48;
  /// Tracked point of a group.
  enum Anchor : std::size_t { kCentre, kBegin, kEnd, kAnchors };
  struct Sighting {
    double at_s = 0.0;  ///< after the first sweep
    std::array<types::Vector2, kAnchors> p{};
    std::array<bool, kAnchors> known{};
  };
  /// In a fixed frame, with the scanner poses from the sweep matches.
  struct Track {
    std::array<Sighting, kLooks> seen{};  ///< oldest first
    std::size_t sightings = 0;
    types::Vector2 velocity_mps{0.0, 0.0};
    double radius_m = 0.0;
    double slow_since_s = 0.0;
    bool moving = false, has_moved = false;
    [[nodiscard]] const Sighting& newest() const { return seen[sightings - 1]; }
    [[nodiscard]] types::Vector2 expected(double at_s) const;
  };
  struct Fit;

  [[nodiscard]] bool continues(const ScanLook& look, const types::Se2& T_odom_laser) const;
  void begin(const types::Se2& T_odom_laser);
  void reckon(const types::Se2& T_odom_laser);
  void doubt();
  void follow_groups();
  [[nodiscard]] Sighting sighting_of(const ScanGroup& group) const;
  void follow(Track& track, const ScanGroup& group);
  void judge(Track& track, const ScanGroup& group);
  [[nodiscard]] bool begins_to_move(const Track& track, const Fit& fit, const ScanGroup& group) const;
  void begin_track(const ScanGroup& group);
  [[nodiscard]] bool was_clear(const ScanGroup& group) const;
  [[nodiscard]] const ScanLook& look(std::size_t age) const {
    return looks_[(newest_ + kLooks - age) % kLooks];
  }
  [[nodiscard]] const types::Se2& pose(std::size_t age) const {
    return poses_[(newest_ + kLooks - age) % kLooks];
  }
  [[nodiscard]] double now_s() const { return types::to_seconds(look(0).stamp - origin_); }

  MovingObstacleParams params_;
  std::array<ScanLook, kLooks> looks_;
  std::array<types::Se2, kLooks> poses_;  ///< of the scanner at each sweep
  std::size_t newest_ = 0, count_ = 0;    ///< of the sweeps
  types::Stamp origin_{};
  types::Se2 T_odom_laser_;  ///< at the newest sweep, from odometry
  types::Se2 T_base_laser_;
  bool trusted_ = false;  ///< the newest sweep fits the static surroundings
  std::array<Track, kTracks> tracks_{};
  std::size_t tracked_ = 0;
};

}  // namespace topo::perception

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/perception/moving_obstacle.hpp"
#include "core/perception/scan_groups.hpp"
#include "core/types/base_state.hpp"

namespace topo::perception {

/// Where the base was or will be at a moment, by a reckoning and its twist; at most 0.3 s off it.
types::Se2 pose_at(const types::Odometry& odometry, types::Stamp when);

/// Which of what the front scanner sees moves, and how: groups of the scan followed over half a second, the
/// robot's own motion taken out by what stands (match_looks). Moving is who covered ground on a line, and
/// stands where half a second ago the scanner saw through: what a view uncovers as the robot drives was
/// hidden, not free (Petrovskaya and Thrun 2009). Of what is half hidden only the free end counts. Who has
/// moved once is believed sooner the next time. Moving ends with standing for a while, and goes on unseen as
/// it went for half a second.
///
/// Slower than 0.2 m/s at first, larger than 0.9 m, farther than 6 m or hidden on both sides: it stands, as
/// far as this says. Fixed size: allocates nothing.
class MovingObstacles {
 public:
  static constexpr std::size_t kMax = 8;

  /// The newest scan and reckoning; takes a scan every tenth of a second and forgets all after a pause or a
  /// jump of the reckoning.
  void update(const types::Scan& scan, const types::Se2& T_base_laser, const types::Odometry& odometry);
  void forget();
  /// What moves, nearest first, in the base's frame of `when`, the place at that moment. Returns how many
  /// were written to `out`.
  std::size_t around(const types::Odometry& odometry, types::Stamp when,
                     std::span<MovingObstacle, kMax> out) const;

 private:
  static constexpr std::size_t kLooks = 6, kTracks = 32, kGroups = 48;
  /// What of a group is followed.
  enum Anchor : std::size_t { kCentre, kBegin, kEnd, kAnchors };
  struct Sighting {
    double at_s = 0.0;  ///< after the first look
    std::array<types::Vector2, kAnchors> p{};
    std::array<bool, kAnchors> known{};
  };
  /// In a frame that stands still, with the looks' own reckoning.
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

  std::array<ScanLook, kLooks> looks_;
  std::array<types::Se2, kLooks> poses_;  ///< of the scanner where each look was
  std::size_t newest_ = 0, count_ = 0;    ///< of the looks
  types::Stamp origin_{};
  types::Se2 T_odom_laser_;  ///< at the newest look, by the base
  types::Se2 T_base_laser_;
  bool trusted_ = false;  ///< the newest look fits what stood before
  std::array<Track, kTracks> tracks_{};
  std::size_t tracked_ = 0;
};

}  // namespace topo::perception

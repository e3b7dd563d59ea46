// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/perception/blind_spot.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/transform.hpp"

namespace topo::motion {

struct FollowerRules {
  double lookahead_m = 0.5;      ///< where on the path "the way" is
  double turn_begin_rad = 0.9;   ///< further off the nose: turn on the spot
  double turn_end_rad = 0.2;     ///< until so near
  double horizon_s = 1.5;        ///< arcs are compared by where they lead in this time
  double extra_margin_m = 0.04;  ///< more than the gate keeps free, so that noise does not make it brake
  double omega_max_radps = 1.0;  ///< while driving
  double crawl_mps = 0.05;       ///< an arc that allows less leads nowhere
  double arrived_m = 0.04;
};

struct FollowInput {
  types::Se2 T_odom_base;  ///< now
  types::Twist2 twist;     ///< given out last
  std::span<const types::Vector2> path_odom;
  std::uint64_t path_number = 0;  ///< another number: another path
  bool ends_at_goal = false;
  std::span<const types::Vector2> obstacles_base;  ///< at most PathFollower::kMaxObstacles
  double blind_s = 0.0;                            ///< as the gate's blind_time_s()
  double alive_s = 0.0;                            ///< as the gate's alive_time_s()
  const types::RobotLimits* limits = nullptr;
};

struct FollowOutput {
  types::Twist2 twist;
  bool arrived = false;
  bool blocked = false;   ///< no arc and no turn leads on
  double turn_rad = 0.0;  ///< from the nose to the way
};

/// Follows a path in odom: compares a fan of arcs by how far they get along the path, each as fast as the
/// gate would let it pass (its rule counts the free way on the arc, so the arcs with much room are the fast
/// ones: dynamic window approach, Fox, Burgard and Thrun 1997), and turns on the spot when the way is far off
/// the nose, or when from another heading an arc gets on better: in a doorway the nose has to point past the
/// jamb first. Allocates nothing.
class PathFollower {
 public:
  static constexpr std::size_t kMaxPoints = 256;
  static constexpr std::size_t kMaxObstacles =
      512 + perception::BlindSpot::kMax;  ///< of a scan, and what is remembered

  explicit PathFollower(const FollowerRules& rules = {}) : rules_(rules) {}
  FollowOutput step(const FollowInput& input);
  void reset();

 private:
  struct Station {
    double s_m = 0.0;         ///< along the path
    double distance_m = 0.0;  ///< from it
    double heading_rad = 0.0;
  };
  struct Arc {
    double curvature = 0.0;
    double v_mps = 0.0;
    double score = -1e9;
  };
  void take_path(const FollowInput& in);
  [[nodiscard]] Station station(const types::Vector2& p, double from_m, double to_m) const;
  [[nodiscard]] types::Vector2 point_at(double s_m) const;
  [[nodiscard]] double speed_on(double curvature, double margin_m, const FollowInput& in) const;
  [[nodiscard]] double slip_speed_mps(const FollowInput& in) const;
  [[nodiscard]] Arc rated(double curvature, double margin_m, double v_cap_mps, const FollowInput& in) const;
  [[nodiscard]] Arc best_with_margin(double margin_m, double v_cap_mps, const FollowInput& in) const;
  [[nodiscard]] Arc best_arc(double v_cap_mps, const FollowInput& in) const;
  [[nodiscard]] double better_turn_rad(const Arc& now, double turn_rad, double v_cap_mps,
                                       const FollowInput& in) const;
  [[nodiscard]] FollowOutput drive(double turn_rad, double rest_m, const FollowInput& in);
  [[nodiscard]] FollowOutput turn(double turn_rad, const FollowInput& in) const;

  FollowerRules rules_;
  std::array<types::Vector2, kMaxPoints> path_{};
  std::array<double, kMaxPoints> s_m_{};
  std::size_t points_ = 0;
  std::uint64_t path_number_ = 0;
  bool has_path_ = false;
  Station here_;
  bool turning_ = false;
  double last_curvature_ = 0.0;
};

}  // namespace topo::motion

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/motion/params.hpp"
#include "core/perception/blind_spot.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/transform.hpp"

namespace topo::motion {

struct FollowInput {
  types::Se2 T_odom_base;  ///< now
  types::Twist2 twist;     ///< last output
  std::span<const types::Vector2> path_odom;
  std::uint64_t path_number = 0;  ///< changes with the path
  bool ends_at_goal = false;
  std::optional<double> turn_to_rad;  ///< in place of a path: the heading in odom to turn to on the spot
  std::span<const types::Vector2> obstacles_base;  ///< at most PathFollower::kMaxObstacles
  double blind_s = 0.0;                            ///< as the gate's blind_time_s()
  double alive_s = 0.0;                            ///< as the gate's alive_time_s()
  const types::RobotLimits* limits = nullptr;
  perception::ContactParams contact{};
};

struct FollowOutput {
  types::Twist2 twist;
  bool arrived = false;   ///< at the end of a path that ends at the goal, or at the heading
  bool blocked = false;   ///< no arc and no turn is possible
  double turn_rad = 0.0;  ///< from the heading to the path
};

/// Follows a path in odom. Compares a fan of arcs by their progress along the path, each as fast as the gate
/// would allow; the gate's rule counts the free distance on the arc, so that arcs with much clearance are
/// fast (dynamic window approach, Fox, Burgard and Thrun 1997). Turns on the spot when the path is far off
/// the heading, or when an arc from another heading scores better: in a doorway the heading must pass the
/// jamb first. Allocates nothing.
class PathFollower {
 public:
  static constexpr std::size_t kMaxPoints = 256;  ///< at least Plan::kMaxPoints
  static constexpr std::size_t kMaxObstacles =
      512 + perception::BlindSpot::kMax;  ///< of a scan, and what is remembered

  explicit PathFollower(const FollowerRules& rules = {}) : rules_(rules) {}
  FollowOutput step(const FollowInput& input);
  void reset();

 private:
  struct Station {
    double s_m = 0.0;         ///< position along the path
    double distance_m = 0.0;  ///< from the path
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
  [[nodiscard]] FollowOutput turn_to(double heading_rad, const FollowInput& in);

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

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/pipeline/planning_step.hpp"

namespace topo::pipeline {

/// A building drawn with characters, one for 0.25 m: '#' wall, 'S' the start, anything else floor. A robot
/// that stands exactly where its plan says sees all around as far as `range_m`, so that the policy is tested
/// without scan matching and wheels.
class ToyBuilding {
 public:
  explicit ToyBuilding(std::vector<std::string> rows, double range_m = 8.0);

  /// Looks around, plans, goes `step_m` along the plan: one planning period of half a second.
  PlanningOutput run_period(PlanningState& state, const Mission& mission, double step_m = 0.3);

  /// Cells of the floor that are known to be free, of those there are around the start.
  [[nodiscard]] double coverage() const;
  [[nodiscard]] types::Vector2 robot() const { return robot_; }
  [[nodiscard]] double path_m() const { return path_m_; }
  /// What a fault shall look like, before the next period.
  ControlReport& control() { return control_; }
  TrackedPose& tracked() { return tracked_; }
  /// What the robot hears of a team from now on; borrowed. Null: it is alone.
  void hear(const TeamInput* team) { team_ = team; }
  /// What its front scanner has from now on; borrowed. Null: nothing.
  void show(const types::Scan* front) { front_ = front; }
  /// The area limits that are in force from now on; borrowed. Null: those of the parameters.
  void limit(const types::AreaLimits* area) { area_ = area; }
  /// What it sees to either side of its heading, from now on.
  void see_within(double half_rad) { half_field_rad_ = half_rad; }
  /// Places where the map is doubted from now on.
  void doubt(std::vector<types::Vector2> places) { doubted_ = std::move(places); }
  [[nodiscard]] types::Stamp now() const { return now_; }
  [[nodiscard]] const MapSnapshot& snapshot() const { return snapshot_; }
  /// All keyframes are `by_m` farther along x, as after a loop closure; the cells stay.
  void bend(double by_m);
  /// A wall from now on, or floor.
  void close(int column, int row);
  void open(int column, int row);

 private:
  [[nodiscard]] bool wall_at(const types::Vector2& p) const;
  void look_around();
  void see(const types::Vector2& p, bool free);
  void follow(const Plan& plan, double step_m);
  void add_keyframe();

  static constexpr double kSide_m = 0.25;
  std::vector<std::string> rows_;  ///< from below
  double range_m_;
  types::Vector2 start_{0.0, 0.0}, robot_{0.0, 0.0};
  double heading_rad_ = 0.0, half_field_rad_ = std::numbers::pi;
  double path_m_ = 0.0;
  patricia::Arena<grid::TileRef> tile_arena_;
  patricia::Arena<walls::Slabs> column_arena_;
  MapSnapshot snapshot_;
  ControlReport control_;
  TrackedPose tracked_;
  const TeamInput* team_ = nullptr;
  const types::Scan* front_ = nullptr;
  const types::AreaLimits* area_ = nullptr;
  std::vector<types::Vector2> doubted_;
  types::Stamp now_ = types::stamp_from_seconds(100.0);
};

}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/grid/distance.hpp"
#include "core/pipeline/goal_choice.hpp"
#include "core/pipeline/planning_step.hpp"

namespace topo::pipeline {

/// What planning remembers; private to planning_step.cpp and the planning_*.cpp files beside it.
struct PlanningState::Impl {
  explicit Impl(const PlannerParams& given) : params(given) {}

  // The step, in the order in which it goes (planning_step.cpp).
  PlanningOutput step(const PlanningInput& in);
  void take_mission(const PlanningInput& in);
  void locate(const PlanningInput& in);
  void stand(const PlanningInput& in, const char* why);
  void watch_battery(const PlanningInput& in);
  [[nodiscard]] bool route_holds(const PlanningInput& in) const;
  void trim_route();
  void think(const PlanningInput& in);
  void decide(const PlanningInput& in);
  [[nodiscard]] std::unique_ptr<PlanningReport> make_report(const PlanningInput& in) const;
  void find_route();
  void make_plan(const PlanningInput& in, Plan& plan) const;

  // The map as it is for travelling (planning_map.cpp).
  void refresh_map(const PlanningInput& in);
  void refresh_analysis(const PlanningInput& in);
  void refresh_travel(const PlanningInput& in);
  void remember_unseen(const types::Vector2& p_map, int times, types::Stamp until);
  void remember_echoes(const PlanningInput& in);
  void remember_touches(const PlanningInput& in);
  /// When no way is left: what only sonar heard, or what the robot got stuck on, may have been wrong. False
  /// when there is nothing to forget, or it was done lately.
  bool forget_unseen(const PlanningInput& in);
  /// What the laser sees within a few metres now.
  [[nodiscard]] std::vector<types::Vector2> seen_now(const PlanningInput& in) const;
  /// What sonar heard, and what the robot got stuck on.
  [[nodiscard]] std::vector<types::Vector2> unseen() const;

  // Where to (planning_goals.cpp).
  void explore(const PlanningInput& in);
  void run_dry(const PlanningInput& in, bool cut_off);
  void settle_goal(const PlanningInput& in);
  [[nodiscard]] std::vector<Candidate> find_candidates(const PlanningInput& in,
                                                       std::span<const goals::Frontier> frontiers,
                                                       bool& cut_off);
  [[nodiscard]] std::vector<Candidate> settled_candidates(const PlanningInput& in, bool& cut_off);
  void take_goal(const PlanningInput& in, const Candidate& candidate);
  void go_home(const PlanningInput& in, std::string why);
  void go_to(const PlanningInput& in);
  [[nodiscard]] std::optional<grid::CellIndex> settled_cell(const types::Vector2& p_map);
  void aim(const PlanningInput& in, const types::Vector2& target, double reached_m, Activity underway);
  void give_up(const PlanningInput& in, std::string why);
  void block_ahead(const PlanningInput& in);
  void note(const PlanningInput& in, const types::Vector2& p_map, std::string text);
  void end(Activity how, std::string why);

  PlannerParams params;
  std::uint64_t sequence = 0;

  // The mission.
  Mission mission;
  Activity activity = Activity::kIdle;
  std::string reason = "no mission yet";
  bool ended = true;
  bool second_phase = false;
  bool returning = false;        ///< an exploration on its way home
  int resumed = 0;               ///< how often it found a goal on its way home
  types::Stamp nothing_since{};  ///< when the last goal in reach was gone; zero: there is one
  bool cut_short = false;        ///< by the battery: what was ordered is not fulfilled by being home
  std::string return_reason;
  types::Stamp battery_low_since{};
  bool battery_low = false;

  // Where the robot is.
  bool located = false;    ///< what follows is of this period
  types::Stamp matched{};  ///< the last scan that matched the map; zero: none
  types::Transform2<types::Map, types::Odom> T_map_odom;
  types::Transform2<types::Map, types::Base> T_map_base, T_map_start;

  // The map.
  std::uint64_t map_revision = 0;
  grid::DenseMap map;
  grid::ClearanceUpdate clearance;  ///< of the map alone
  AnalysisMemory analysis_memory;
  std::vector<float> travel_clearance_m;  ///< and of what stands there now
  double known_m2 = 0.0;
  std::shared_ptr<const Analysis> analysis;
  types::Stamp analysed{};
  grid::TravelSearch search;
  grid::TravelField field;  ///< as far as the search has come

  // The goal.
  std::uint64_t goal_id = 0;
  std::optional<goals::Goal> goal;
  grid::CellIndex target;
  bool has_target = false;
  types::Stamp goal_taken{}, last_progress{};
  types::Vector2 progress_at{0.0, 0.0};
  GivenUpGoals given_up;
  struct Blocked {
    types::Vector2 p_map{0.0, 0.0};
    types::Stamp until{};
    int times = 1;  ///< how often something was noticed there
  };
  std::vector<Blocked> blocked;  ///< where the robot did not get on
  std::vector<Blocked> echoes;   ///< where sonar hears, or the robot touched, what no laser sees
  std::uint32_t touches = 0;     ///< of control's count, those remembered
  types::Stamp forgotten{};
  std::vector<goals::Goal> open_goals;
  std::vector<Decision> decisions;
  std::vector<types::Vector2> route;  ///< to the target, in map
  types::Stamp thought{};         ///< when it was found; zero: something happened that it does not know of
  KeyframePose newest;            ///< of the map it was made on
  std::size_t newest_number = 0;  ///< among its keyframes
  int clusters = 0;
  std::uint64_t goals_issued = 0, decisions_made = 0, clusters_sum = 0, goals_sum = 0;
};

}  // namespace topo::pipeline

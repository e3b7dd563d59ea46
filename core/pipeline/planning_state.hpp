// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/exploration/goal_choice.hpp"
#include "core/exploration/goal_ways.hpp"
#include "core/exploration/tour.hpp"
#include "core/grid/clearance_update.hpp"
#include "core/pipeline/planning_step.hpp"
#include "core/team/homes.hpp"
#include "core/team/last_contact.hpp"
#include "core/travel/far_route.hpp"

namespace topo::pipeline {

/// Where robots were, each by itself: corrected poses of its keyframes, in map.
std::vector<std::vector<types::Vector2>> driven_paths(const MapSnapshot& snapshot);

/// The newest keyframe of a map, to be found again in a later one: odometry that drifts moves the robot on
/// the map, and no keyframe.
struct NewestKeyframe {
  NewestKeyframe() = default;
  explicit NewestKeyframe(const MapSnapshot& map)
      : keyframe(map.keyframes.back()), number(map.keyframes.size() - 1) {}
  /// Was the map bent there, by more than that? So it is where the keyframe is missing.
  [[nodiscard]] bool is_bent(const MapSnapshot& now, double by_m, double by_rad) const;

  types::KeyframePose keyframe;
  std::size_t number = 0;  ///< among the map's
};

/// What planning remembers; private to planning_step.cpp and the planning_*.cpp files beside it.
struct PlanningState::Impl {
  explicit Impl(const PlannerParams& given)
      : params(given), looks(given.final_sweep), roster(given.roster), contact(given.contact_lost_s) {}

  // The step, in the order in which it goes (planning_step.cpp).
  PlanningOutput step(const PlanningInput& in);
  void take_mission(const PlanningInput& in);
  void locate(const PlanningInput& in);
  void stand(const PlanningInput& in, const char* why);
  void watch_battery(const PlanningInput& in);
  void watch_bends(const PlanningInput& in);
  [[nodiscard]] bool route_holds(const PlanningInput& in) const;
  void trim_route();
  void think(const PlanningInput& in);
  void decide(const PlanningInput& in);
  [[nodiscard]] std::unique_ptr<PlanningReport> make_report(const PlanningInput& in) const;
  void find_route();
  [[nodiscard]] std::vector<grid::CellIndex> cells_to_target();
  void make_plan(const PlanningInput& in, Plan& plan) const;

  // The map as it is for travelling (planning_map.cpp).
  void refresh_map(const PlanningInput& in);
  /// Is there more to know than when the last decision was made: in all, or around the goal, where a glance
  /// through a door closes it?
  [[nodiscard]] bool has_changed(const PlanningInput& in) const;
  void refresh_analysis(const PlanningInput& in);
  void refresh_travel(const PlanningInput& in);
  /// `coarse` and its field, in this period, when they are first asked for.
  void need_coarse();
  void remember_unseen(const types::Vector2& p_map, int times, types::Stamp until);
  void remember_echoes(const PlanningInput& in);
  void remember_touches(const PlanningInput& in);
  /// When no way is left: what only sonar heard, or what the robot got stuck on, may have been wrong. False
  /// when there is nothing to forget, or it was done lately.
  bool forget_unseen(const PlanningInput& in);
  /// What the laser sees within a few metres now.
  [[nodiscard]] std::vector<types::Vector2> seen_now(const PlanningInput& in) const;
  /// What only sonar heard, often enough.
  [[nodiscard]] std::vector<types::Vector2> echoed() const;
  /// Where the robot did not get on.
  [[nodiscard]] std::vector<types::Vector2> stuck_on() const;

  // Where to (planning_goals.cpp).
  void explore(const PlanningInput& in);
  void run_dry(const PlanningInput& in, bool cut_off);
  void settle_goal(const PlanningInput& in);
  [[nodiscard]] std::vector<exploration::Candidate> candidates_among(const PlanningInput& in,
                                                                     std::span<const goals::Goal> goals,
                                                                     bool& cut_off) const;
  [[nodiscard]] std::vector<exploration::Candidate> gap_candidates(const PlanningInput& in,
                                                                   std::span<const goals::Frontier> frontiers,
                                                                   double behind_min_m2, bool& cut_off) const;
  [[nodiscard]] std::vector<exploration::Candidate> frontier_candidates(const PlanningInput& in,
                                                                        bool& cut_off);
  void take_goal(const PlanningInput& in, const exploration::Candidate& candidate);
  void set_out(const PlanningInput& in, const goals::Goal& to);
  /// For how long it has not got on.
  [[nodiscard]] types::Duration standing_for(const PlanningInput& in);
  [[nodiscard]] bool is_getting_on(const PlanningInput& in);
  void go_home(const PlanningInput& in, std::string why);
  void go_to(const PlanningInput& in);
  [[nodiscard]] std::optional<grid::CellIndex> reachable_cell(const types::Vector2& p_map);
  void aim(const PlanningInput& in, const types::Vector2& target, double reached_m, Activity underway);
  void give_up(const PlanningInput& in, std::string why);
  void give_up_caught(const PlanningInput& in, std::string why);
  [[nodiscard]] std::optional<types::Vector2> tight_ahead() const;
  void block_ahead(const PlanningInput& in);
  void note(const PlanningInput& in, const types::Vector2& p_map, std::string text);

  // In which order (planning_tour.cpp).
  [[nodiscard]] std::vector<exploration::Candidate> tour_candidates(const PlanningInput& in, bool& cut_off);
  [[nodiscard]] bool is_unlikely_goal_cut_off(const PlanningInput& in) const;
  void leave_overlooked(std::vector<goals::Frontier>& frontiers) const;
  void add_gaps(const PlanningInput& in, std::vector<goals::Frontier> frontiers,
                std::vector<exploration::Candidate>& candidates, bool& cut_off) const;
  [[nodiscard]] bool looks_around() const;
  /// When a goal that was just visited may be one again; nothing: never.
  [[nodiscard]] std::optional<types::Stamp> next_visit(types::Stamp now) const;
  void settle_looks(const PlanningInput& in);
  void find_looks(const PlanningInput& in);
  void add_looks(std::vector<exploration::Candidate>& candidates, bool& cut_off) const;
  void estimate_far_ones(std::vector<exploration::Candidate>& candidates);
  [[nodiscard]] exploration::TourGoals tour_goals(std::span<const exploration::Candidate* const> candidates);
  /// Where the cheapest tour of these begins, unless one that begins with `present` costs hardly more.
  [[nodiscard]] const exploration::Candidate* first_of_tour(
      std::vector<const exploration::Candidate*> candidates, const exploration::Candidate* present);

  // With others (planning_team.cpp).
  /// Who counts, and what it claims.
  using Claims = std::vector<std::pair<std::uint16_t, std::optional<types::Vector2>>>;
  void hear(const PlanningInput& in);
  /// The candidate to go for, by what the team knows; null: none, or others have them.
  const exploration::Candidate* pick(const PlanningInput& in,
                                     std::span<const exploration::Candidate> candidates,
                                     const exploration::Candidate* present);
  /// Does it heed what mates want and where they were? Without coordination robots share their maps alone
  /// (Yamauchi 1998).
  [[nodiscard]] bool is_coordinated(const PlanningInput& in) const;
  [[nodiscard]] bool mate_was_at(const PlanningInput& in, const exploration::Candidate& candidate,
                                 double within_m) const;
  [[nodiscard]] bool others_have_goals(const PlanningInput& in) const;
  [[nodiscard]] Claims claims_of_mates(const PlanningInput& in) const;
  [[nodiscard]] bool mates_claim_the_same(const PlanningInput& in) const;
  void wait_for_goal(const PlanningInput& in, const char* why);
  /// Is it time to make room for a mate, or to stop doing so?
  [[nodiscard]] bool right_of_way_changed(const PlanningInput& in) const;
  /// Does it, at home, go on to where a mate that wants to pass is bound for (core/team/homes.hpp)?
  [[nodiscard]] bool moves_up_for(const PlanningInput& in, const team::StatusMessage& mate) const;
  /// Goes out of a mate's way; false when nobody needs it.
  bool make_room(const PlanningInput& in);
  void wait_at_home(const PlanningInput& in);
  /// At the end of a team's exploration; not when the operator sends this robot home.
  [[nodiscard]] bool comes_home_with_others(const PlanningInput& in) const;
  /// Where this robot comes home to: its start, or another's when it comes with others (core/team/homes.hpp).
  [[nodiscard]] types::Vector2 home_of(const PlanningInput& in);
  [[nodiscard]] const team::StatusMessage* who_needs_room(const PlanningInput& in) const;
  [[nodiscard]] team::StatusMessage make_message(const PlanningInput& in) const;
  /// Is what is there a mate that will go on? One that stands for good is an obstacle like any other.
  [[nodiscard]] bool is_going_mate(const types::Vector2& p_map) const;
  /// Is a mate that moves so near that this robot has to go slowly (core/team/precedence.hpp)?
  [[nodiscard]] bool slows_for_mate(const PlanningInput& in) const;
  /// Would backing off lead towards a mate? The rear sees nothing, and the way it came is no longer free.
  [[nodiscard]] bool is_mate_behind(const PlanningInput& in) const;
  /// Routes lead round mates that are going where there is room, and through where they stand where there is
  /// none.
  void crowd_mates();
  void end(Activity how, std::string why);

  // Out of contact (planning_contact.cpp).
  /// Goes back to where a mate was last heard; false when there is no need, or no way.
  bool seek_contact(const PlanningInput& in);
  void end_seeking(const PlanningInput& in, const char* how);

  PlannerParams params;
  std::uint64_t sequence = 0;

  // The mission.
  Mission mission;
  Activity activity = Activity::kIdle;
  std::string reason = "no mission yet";
  std::string hindrance;  ///< why nothing can be planned in this period; empty: it can
  bool ended = true;
  bool second_phase = false;
  bool returning = false;        ///< an exploration on its way home
  int resumed = 0;               ///< how often it found a goal on its way home
  int caught = 0;                ///< and did not get on where it stood
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
  NewestKeyframe latest;    ///< of the period before
  std::uint32_t bends = 0;  ///< Plan::bends

  // The map.
  std::uint64_t map_revision = 0;
  grid::DenseMap map;
  grid::ClearanceUpdate clearance;        ///< of the map alone
  std::vector<float> travel_clearance_m;  ///< and of what stands there now
  double known_m2 = 0.0;
  std::shared_ptr<const analysis::Analysis> analysis;
  analysis::AnalysisMemory analysis_memory;
  types::Stamp analysed{};
  types::Stamp idle_since{};  ///< without a goal; zero: with one
  grid::TravelSearch search;
  grid::TravelField field;   ///< as far as the search has come
  bool has_coarse = false;   ///< of this period
  travel::CoarseMap coarse;  ///< the map for travelling in cells four times as wide, for what is far
  grid::TravelSearch coarse_search;
  grid::TravelField coarse_field;
  exploration::GoalWays goal_ways;  ///< of the last tour
  travel::FarRoute far_route;

  // The goal.
  std::uint64_t goal_id = 0;
  std::optional<goals::Goal> goal;
  grid::CellIndex target;
  bool has_target = false;
  types::Stamp goal_taken{}, last_progress{};
  types::Vector2 progress_at{0.0, 0.0};
  exploration::DeferredGoals deferred;
  exploration::FinalSweep looks;
  bool looks_meanwhile = false;  ///< though there are goals, to which no way leads
  struct Blocked {
    types::Vector2 p_map{0.0, 0.0};
    types::Stamp until{};
    int times = 1;  ///< how often something was noticed there
  };
  std::vector<Blocked> blocked;           ///< where the robot did not get on
  std::vector<types::Vector2> too_tight;  ///< the same in passages in which it cannot turn
  std::vector<Blocked> echoes;            ///< where sonar hears, or the robot touched, what no laser sees
  std::uint32_t touches = 0;              ///< of control's count, those remembered
  types::Stamp forgotten{};
  std::vector<goals::Goal> open_goals;
  std::vector<Decision> decisions;
  std::vector<types::Vector2> route;  ///< to the target, in map
  types::Stamp thought{};           ///< when it was found; zero: something happened that it does not know of
  std::uint64_t thought_cells = 0;  ///< MapSnapshot::changed_cells of the map then
  NewestKeyframe newest;            ///< of the map it was made on
  int clusters = 0;

  // The team.
  team::Roster roster;
  team::LastContact contact;
  bool seeks_contact = false;
  std::vector<types::Vector2> going_at;  ///< Roster::going_at() of this period
  std::uint64_t messages = 0;
  std::vector<team::Bid> bids;
  Claims claims_then;              ///< when the last decision was made
  double claimed_m = 0.0;          ///< what the goal's way counted when the goal was taken
  bool at_home = false;            ///< and the others are not yet
  std::optional<team::Home> home;  ///< the start that it comes home to
  struct Room {
    std::uint16_t mate = 0;
    types::Vector2 asked_at{0.0, 0.0};
    types::Stamp since{};
    grid::CellIndex goal_target;  ///< where the robot was bound to, and is again afterwards
  };
  std::optional<Room> room;          ///< made for a mate now
  types::Stamp ignore_room_until{};  ///< making room did not help: for a while each goes its way
  std::uint64_t goals_issued = 0, decisions_made = 0, clusters_sum = 0, goals_sum = 0;
};

}  // namespace topo::pipeline

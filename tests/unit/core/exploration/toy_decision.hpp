// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"
#include "core/goals/frontiers.hpp"
#include "tests/unit/core/pipeline/toy_building.hpp"

namespace topo::exploration {

/// A corridor with a room at either end, of which a robot in the middle has seen a part.
inline std::vector<std::string> corridor_and_rooms() {
  std::vector<std::string> rows(28, std::string(80, '#'));
  for (std::size_t y = 2; y < 26; ++y) {
    rows[y].replace(2, 20, 20, ' ');
    rows[y].replace(58, 20, 20, ' ');
  }
  for (std::size_t y = 11; y < 16; ++y) rows[y].replace(22, 36, 36, ' ');
  rows[13][40] = 'S';
  return rows;
}

/// One decision's situation after the first look around.
class ToyDecision : public ::testing::Test {
 protected:
  explicit ToyDecision(const std::vector<std::string>& rows = corridor_and_rooms(), double range_m = 6.0)
      : building_(rows, range_m), map_({}, {}) {
    pipeline::PlanningState state(planner_);
    analysis_ = building_.run_period(state, {1, Order::kExplore, false, {0.0, 0.0}}, 0.0).report->analysis;
    const pipeline::MapSnapshot& snapshot = building_.snapshot();
    const travel::DrivenWays ways{snapshot.keyframes, snapshot.mates};
    map_.take(snapshot.revision, snapshot.grid, ways);
    map_.begin(snapshot.keyframes.back(), ways, {});
    map_.settle(HUGE_VAL);
  }

  [[nodiscard]] Situation situation() const {
    return {.now = building_.now(),
            .T_map_base = {building_.robot().x(), building_.robot().y(), 0.0},
            .start = building_.robot(),
            .mission = {1, Order::kExplore, false, {0.0, 0.0}},
            .battery_low = false,
            .feedback = {},
            .analysis = *analysis_,
            .essential = planner_.analysis.goals,
            .route = {},
            .team = {5, roster_, {}}};
  }
  [[nodiscard]] std::vector<goals::Frontier> frontiers() const {
    return goals::find_frontiers(map_.map(), params_.frontier_min_m);
  }
  void hear(const team::StatusMessage& message) { roster_.take(message, building_.now()); }

  [[nodiscard]] Searches searches() { return {map_, ways_}; }
  /// What a mate in the middle of the corridor, or far away, says at its best.
  [[nodiscard]] static team::StatusMessage mate_at(std::uint16_t robot, const types::Vector2& p_map) {
    team::StatusMessage mate;
    mate.robot = robot;
    mate.sequence = 1;
    mate.T_map_base = {p_map.x(), p_map.y(), 0.0};
    mate.start = p_map;
    mate.duty = team::Duty::kAble;
    return mate;
  }
  [[nodiscard]] types::Vector2 here() const { return building_.robot(); }
  [[nodiscard]] static bool has_note(const Intent& intent, const std::string& text) {
    const auto& all = intent.log.decisions;
    return std::any_of(all.begin(), all.end(), [&](const Decision& d) { return d.text.starts_with(text); });
  }

  pipeline::PlannerParams planner_;
  ExplorationParams params_;
  pipeline::ToyBuilding building_;
  travel::RouteMap map_;
  GoalWays ways_;
  team::Roster roster_;
  DeferredGoals deferred_;
  std::shared_ptr<const analysis::Analysis> analysis_;
};

}  // namespace topo::exploration

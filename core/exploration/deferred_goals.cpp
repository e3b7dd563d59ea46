// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/deferred_goals.hpp"

#include <algorithm>
#include <iterator>

namespace topo::exploration {

namespace {

bool is_held(const DeferredGoal& goal, types::Stamp now) { return goal.is_for_good() || now < goal.until; }

}  // namespace

void DeferredGoals::give_up(const types::Vector2& p_map, types::Stamp until, std::string why) {
  note({.p_map = p_map, .until = until, .times = 1, .why = std::move(why)});
}

void DeferredGoals::visit(const types::Vector2& p_map, std::optional<types::Stamp> until) {
  note({.p_map = p_map,
        .until = until.value_or(types::Stamp{}),
        .times = 1,
        .why = "visited",
        .visited = true,
        .forbidden = !until});
}

void DeferredGoals::vanish(const types::Vector2& p_map, types::Stamp until) {
  auto same = same_as(p_map);
  if (same == list_.end()) same = list_.insert(same, {.p_map = p_map});
  if (++same->vanished < 2 || same->until >= until) return;
  same->until = until;
  same->why = "no goal whenever the robot turned to it";
}

std::vector<DeferredGoal>::iterator DeferredGoals::same_as(const types::Vector2& p_map) {
  return std::find_if(list_.begin(), list_.end(),
                      [&](const DeferredGoal& g) { return (g.p_map - p_map).norm() <= params_.same_m; });
}

void DeferredGoals::note(DeferredGoal goal) {
  const auto same = same_as(goal.p_map);
  const bool is_new = same == list_.end();
  if (!is_new) {
    goal.p_map = same->p_map;
    goal.times = same->times + 1;
    goal.vanished = same->vanished;
  }
  goal.forbidden = goal.forbidden || goal.times >= params_.times_max;
  if (is_new)
    list_.push_back(std::move(goal));
  else
    *same = std::move(goal);
}

bool DeferredGoals::hold(const types::Vector2& p_map, types::Stamp now) const {
  return std::any_of(list_.begin(), list_.end(), [&](const DeferredGoal& g) {
    return (g.p_map - p_map).norm() <= params_.same_m && is_held(g, now);
  });
}

std::vector<types::Vector2> DeferredGoals::visited(types::Stamp now) const {
  std::vector<types::Vector2> held;
  for (const DeferredGoal& g : list_) {
    if (g.visited && is_held(g, now)) held.push_back(g.p_map);
  }
  return held;
}

std::vector<DeferredGoal> DeferredGoals::held(types::Stamp now) const {
  std::vector<DeferredGoal> all;
  std::copy_if(list_.begin(), list_.end(), std::back_inserter(all),
               [now](const DeferredGoal& g) { return is_held(g, now); });
  return all;
}

bool DeferredGoals::call_back(types::Stamp now) {
  bool any = false;
  for (DeferredGoal& g : list_) {
    if (g.is_for_good() || g.until <= now) continue;
    g.until = now;
    any = true;
  }
  return any;
}

}  // namespace topo::exploration

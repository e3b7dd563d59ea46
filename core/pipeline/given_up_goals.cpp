// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/given_up_goals.hpp"

#include <algorithm>

namespace topo::pipeline {

void GivenUpGoals::add(const types::Vector2& p_map, types::Stamp until, std::string why) {
  const auto same = std::find_if(list_.begin(), list_.end(),
                                 [&](const GivenUp& g) { return (g.p_map - p_map).norm() <= kSame_m; });
  if (same == list_.end()) {
    list_.push_back({p_map, until, 1, std::move(why)});
    return;
  }
  same->until = until;
  same->why = std::move(why);
  ++same->times;
}

bool GivenUpGoals::hold(const types::Vector2& p_map, types::Stamp now) const {
  return std::any_of(list_.begin(), list_.end(), [&](const GivenUp& g) {
    return (g.p_map - p_map).norm() <= kSame_m && (g.times >= kTimesMax || now < g.until);
  });
}

std::vector<types::Vector2> GivenUpGoals::held_for(const std::string& why, types::Stamp now) const {
  std::vector<types::Vector2> held;
  for (const GivenUp& g : list_) {
    if (g.why == why && (g.times >= kTimesMax || now < g.until)) held.push_back(g.p_map);
  }
  return held;
}

bool GivenUpGoals::call_back(types::Stamp now) {
  bool any = false;
  for (GivenUp& g : list_) {
    if (g.times >= kTimesMax || g.until <= now) continue;
    g.until = now;
    any = true;
  }
  return any;
}

}  // namespace topo::pipeline

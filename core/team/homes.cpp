// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/homes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/team/k_means.hpp"

namespace topo::team {
namespace {

using types::Vector2;

bool is_near(const Vector2& a, const Vector2& b, double at_start_m) { return (a - b).norm() <= at_start_m; }

bool takes(const StatusMessage& mate, const Home& start, const StatusMessage& self, double at_start_m) {
  if (is_near(self.T_map_base.translation(), start.p_map, at_start_m))
    return false;  // a robot that stands there does not leave again
  const bool there = is_near(mate.T_map_base.translation(), start.p_map, at_start_m);
  if (there && mate.way_map.empty()) return true;
  const bool first = there || (mate.robot < self.robot && start.from != mate.robot);
  return mate.home && is_near(*mate.home, start.p_map, at_start_m) && first;
}

/// All starts, in an order that is the same for all robots.
std::vector<Home> starts_of(const StatusMessage& self, std::span<const StatusMessage* const> mates) {
  std::vector<Home> starts{{self.robot, self.start}};
  for (const StatusMessage* mate : mates) starts.push_back({mate->robot, mate->start});
  std::sort(starts.begin(), starts.end(),
            [](const Home& a, const Home& b) { return comes_before(a.p_map, b.p_map); });
  return starts;
}

}  // namespace

bool is_at_home(const StatusMessage& self, const Home& home, double at_start_m) {
  return is_near(self.T_map_base.translation(), home.p_map, at_start_m);
}

std::optional<Home> start_beside(const StatusMessage& self, std::span<const StatusMessage* const> mates,
                                 double at_start_m) {
  const std::vector<Home> starts = starts_of(self, mates);
  const auto away_m = [&](const Home& start) { return (self.T_map_base.translation() - start.p_map).norm(); };
  const auto nearest = std::ranges::min_element(starts, {}, away_m);
  if (!is_at_home(self, *nearest, at_start_m)) return std::nullopt;
  return *nearest;
}

std::optional<Home> choose_home(const StatusMessage& self, std::span<const StatusMessage* const> mates,
                                const std::optional<Home>& present, const StatusMessage* passing,
                                const std::function<double(const Vector2&)>& cost_m, double at_start_m) {
  const auto is_open = [&](const Home& start) {
    return std::none_of(mates.begin(), mates.end(),
                        [&](const StatusMessage* mate) { return takes(*mate, start, self, at_start_m); });
  };
  const std::vector<Home> starts = starts_of(self, mates);
  if (passing != nullptr && passing->home && present && is_at_home(self, *present, at_start_m)) {
    for (Home start : starts) {
      start.from = passing->robot;
      if (is_near(*passing->home, start.p_map, at_start_m) && is_open(start) &&
          std::isfinite(cost_m(start.p_map)))
        return start;
    }
  }
  if (present) {
    const auto now = std::find_if(starts.begin(), starts.end(),
                                  [&](const Home& start) { return start.robot == present->robot; });
    const Home kept{present->robot, now != starts.end() ? now->p_map : present->p_map, present->from};
    if (is_open(kept)) return kept;
  }
  std::optional<Home> best;
  double best_m = -1.0;
  for (const Home& start : starts) {
    const double cost = cost_m(start.p_map);
    if (!is_open(start) || std::isinf(cost) || cost <= best_m) continue;
    best_m = cost;
    best = start;
  }
  return best;
}

}  // namespace topo::team

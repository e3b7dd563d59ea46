// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/bound/legs.hpp"

#include <algorithm>
#include <cmath>

namespace topo::bench::bound {

std::vector<Look> looks_on(const Way& way, double look_m) {
  std::vector<Look> looks;
  double way_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const sim::Vector2 leg = way[i] - way[i - 1];
    const int n = std::max(1, static_cast<int>(std::ceil(leg.norm() / look_m)));
    for (int k = 0; k < n; ++k) {
      const double part = static_cast<double>(k) / n;
      looks.push_back({way_m + part * leg.norm(), way[i - 1] + part * leg});
    }
    way_m += leg.norm();
  }
  if (!way.empty()) looks.push_back({way_m, way.back()});
  return looks;
}

Legs::Legs(const WayMap& ways, const Sight& sight, std::vector<sim::Vector2> nodes, double look_m)
    : map_(ways), sight_(sight), nodes_(std::move(nodes)), look_m_(look_m) {
  for (const sim::Vector2& node : nodes_) fields_.push_back(map_.field_to({&node, 1}));
  lengths_.assign(nodes_.size(), std::vector<double>(nodes_.size(), 0.0));
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Way& leg = way(k, i);
      lengths_[i][k] = lengths_[k][i] = leg.empty() ? HUGE_VAL : length_m(leg);
    }
  }
}

const Way& Legs::way(std::size_t from, std::size_t to) {
  const auto found = ways_.find({from, to});
  if (found != ways_.end()) return found->second;
  // Of both directions one is looked for, so that both are equally long.
  const std::size_t low = std::min(from, to), high = std::max(from, to);
  Way leg = map_.way(fields_[high], nodes_[low]);
  if (from > to) std::reverse(leg.begin(), leg.end());
  return ways_.emplace(std::pair(from, to), std::move(leg)).first->second;
}

const CellSet& Legs::seen_at(std::size_t node) {
  const auto found = seen_at_.find(node);
  if (found != seen_at_.end()) return found->second;
  return seen_at_.emplace(node, sight_.from(nodes_[node])).first->second;
}

const CellSet& Legs::seen_on(std::size_t from, std::size_t to) {
  const std::pair key(std::min(from, to), std::max(from, to));
  const auto found = seen_on_.find(key);
  if (found != seen_on_.end()) return found->second;
  CellSet seen(sight_.cells());
  for (const Look& look : looks_on(way(key.first, key.second), look_m_)) seen |= sight_.from(look.at);
  return seen_on_.emplace(key, std::move(seen)).first->second;
}

std::vector<Look> Legs::looks(std::size_t start, const std::vector<std::size_t>& stops) {
  std::vector<Look> all{{0.0, nodes_[start]}};
  double way_m = 0.0;
  for (const std::size_t stop : stops) {
    // Of both directions the one that seen_on() looks in, so that the very same cells are seen.
    std::vector<Look> leg = looks_on(way(std::min(start, stop), std::max(start, stop)), look_m_);
    const double leg_m = leg.empty() ? 0.0 : leg.back().way_m;
    if (start > stop) {
      std::reverse(leg.begin(), leg.end());
      for (Look& look : leg) look.way_m = leg_m - look.way_m;
    }
    for (const Look& look : leg) all.push_back({way_m + look.way_m, look.at});
    way_m += leg_m;
    start = stop;
  }
  return all;
}

Way Legs::whole_way(std::size_t start, const std::vector<std::size_t>& stops) {
  Way whole{nodes_[start]};
  for (const std::size_t stop : stops) {
    const Way& leg = way(start, stop);
    whole.insert(whole.end(), leg.begin(), leg.end());
    start = stop;
  }
  return whole;
}

}  // namespace topo::bench::bound

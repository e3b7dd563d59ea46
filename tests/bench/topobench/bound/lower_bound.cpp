// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iterator>
#include <queue>

#include "tests/bench/topobench/bound/bound.hpp"

namespace topo::bench::bound {
namespace {

/// Way to the nearest place from which each cell is seen.
std::vector<double> first_sight_m(const WayMap& ways, const WayMap::Field& from_start, const Sight& sight,
                                  std::span<const sim::Vector2> places, std::span<const CellSet> seen) {
  std::vector<double> first(sight.cells(), HUGE_VAL);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double way_m = ways.distance_m(from_start, places[i]);
    for (std::size_t c = 0; c < first.size(); ++c) {
      if (way_m < first[c] && seen[i].contains(c)) first[c] = way_m;
    }
  }
  return first;
}

/// Connected parts of the floor of more than `cells_min` cells, the farthest first, apart from each other.
std::vector<CellSet> patches_of(const Sight& sight, const std::vector<double>& first, std::size_t cells_min) {
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < first.size(); ++c) {
    if (std::isfinite(first[c])) order.push_back(c);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return first[a] > first[b]; });
  std::vector<bool> taken(first.size(), false);
  std::vector<CellSet> patches;
  for (const std::size_t seed : order) {
    if (taken[seed]) continue;
    // Grows into what is seen latest.
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry> open;
    CellSet patch(first.size());
    std::size_t cells = 0;
    open.emplace(first[seed], seed);
    taken[seed] = true;
    while (!open.empty() && cells <= cells_min) {
      const std::size_t cell = open.top().second;
      open.pop();
      patch.insert(cell);
      ++cells;
      for (const std::size_t next : sight.beside(cell)) {
        if (taken[next] || !std::isfinite(first[next])) continue;
        taken[next] = true;
        open.emplace(first[next], next);
      }
    }
    // Those that wait at the rim are free for others.
    for (; !open.empty(); open.pop()) taken[open.top().second] = false;
    if (cells > cells_min) patches.push_back(std::move(patch));
  }
  return patches;
}

std::vector<sim::Vector2> places_that_see(const CellSet& patch, std::span<const sim::Vector2> places,
                                          std::span<const CellSet> seen) {
  std::vector<sim::Vector2> out;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (seen[i].meets(patch)) out.push_back(places[i]);
  }
  return out;
}

}  // namespace

double lower_bound_m(double share, const WayMap& ways, const Sight& sight,
                     std::span<const sim::Vector2> places, std::span<const CellSet> seen,
                     std::span<const sim::Vector2> starts, double spacing_m) {
  const WayMap::Field from_start = ways.field_to(starts);
  const std::vector<double> first = first_sight_m(ways, from_start, sight, places, seen);
  const auto missed = static_cast<std::size_t>((1.0 - share) * static_cast<double>(first.size()));
  // A place stands for what lies half a square around it: two of them for either end of a way.
  const double slack_m = std::sqrt(2.0) * spacing_m;
  const auto less = [&](double way_m) { return std::max(0.0, way_m / WayMap::kLonger - slack_m); };
  // What no place sees, something between them may: it costs nothing here.
  std::vector<double> sorted;
  std::copy_if(first.begin(), first.end(), std::back_inserter(sorted),
               [](double m) { return std::isfinite(m); });
  std::sort(sorted.begin(), sorted.end());
  const double farthest_m =
      sorted.empty() ? 0.0 : sorted[sorted.size() - 1 - std::min(missed, sorted.size() - 1)];
  const std::vector<CellSet> patches = patches_of(sight, first, missed);
  std::vector<std::vector<sim::Vector2>> sets{{starts.begin(), starts.end()}};
  for (const CellSet& patch : patches) sets.push_back(places_that_see(patch, places, seen));
  Lengths lengths(sets.size(), std::vector<double>(sets.size(), 0.0));
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    nodes.push_back(i);
    const WayMap::Field field = ways.field_to(sets[i]);
    for (std::size_t k = 0; k < i; ++k) {
      double nearest_m = HUGE_VAL;
      for (const sim::Vector2& place : sets[k])
        nearest_m = std::min(nearest_m, ways.distance_m(field, place));
      lengths[i][k] = lengths[k][i] = less(nearest_m);
    }
  }
  const double tree_m =
      spanning_tree_m(lengths, nodes) / static_cast<double>(std::max<std::size_t>(starts.size(), 1));
  return std::max(less(farthest_m), std::isfinite(tree_m) ? tree_m : 0.0);
}

}  // namespace topo::bench::bound

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/bound/bound.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "tests/bench/topobench/bound/legs.hpp"

namespace topo::bench::bound {
namespace {

constexpr int kPrunings = 3;

CellSet seen_by(Legs& legs, const std::vector<std::size_t>& starts, const Tours& tours, std::size_t cells) {
  CellSet seen(cells);
  for (std::size_t r = 0; r < tours.size(); ++r) {
    seen |= legs.seen_at(starts[r]);
    std::size_t from = starts[r];
    for (const std::size_t stop : tours[r]) {
      seen |= legs.seen_on(from, stop);
      from = stop;
    }
  }
  return seen;
}

/// Leaves out stops that are seen on the way anyhow, the greatest detours first.
bool prune(Legs& legs, const std::vector<std::size_t>& starts, std::size_t cells, std::size_t wanted,
           Tours& tours) {
  struct Detour {
    double saved_m;
    std::size_t stop;
  };
  std::vector<Detour> detours;
  for (std::size_t r = 0; r < tours.size(); ++r) {
    for (std::size_t i = 0; i < tours[r].size(); ++i) {
      std::vector<std::size_t> without = tours[r];
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
      detours.push_back({open_length_m(legs.lengths(), starts[r], tours[r]) -
                             open_length_m(legs.lengths(), starts[r], without),
                         tours[r][i]});
    }
  }
  std::sort(detours.begin(), detours.end(),
            [](const Detour& a, const Detour& b) { return a.saved_m > b.saved_m; });
  bool any = false;
  for (const Detour& detour : detours) {
    Tours without = tours;
    for (std::vector<std::size_t>& tour : without) std::erase(tour, detour.stop);
    if (seen_by(legs, starts, without, cells).size() < wanted) continue;
    tours = std::move(without);
    any = true;
  }
  return any;
}

double longest_m(const Lengths& lengths, const std::vector<std::size_t>& starts, const Tours& tours) {
  double longest = 0.0;
  for (std::size_t r = 0; r < tours.size(); ++r)
    longest = std::max(longest, open_length_m(lengths, starts[r], tours[r]));
  return longest;
}

/// Tours that see `wanted` cells, from a cover that does.
Tours tours_of(Legs& legs, const std::vector<std::size_t>& starts, std::vector<std::size_t> stops,
               std::size_t cells, std::size_t wanted) {
  Tours best = share_out(legs.lengths(), starts, stops);
  for (int i = 0; i < kPrunings && prune(legs, starts, cells, wanted, best); ++i) {
    stops.clear();
    for (const std::vector<std::size_t>& tour : best) stops.insert(stops.end(), tour.begin(), tour.end());
    // In another order other things are seen on the way.
    Tours again = share_out(legs.lengths(), starts, stops);
    if (seen_by(legs, starts, again, cells).size() >= wanted &&
        longest_m(legs.lengths(), starts, again) < longest_m(legs.lengths(), starts, best))
      best = std::move(again);
  }
  return best;
}

Way first_part(const Way& way, double until_m) {
  Way part;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i > 0) {
      const double leg_m = (way[i] - way[i - 1]).norm();
      if (leg_m >= until_m) {
        if (leg_m > 0.0) part.push_back(way[i - 1] + (way[i] - way[i - 1]) * (until_m / leg_m));
        return part;
      }
      until_m -= leg_m;
    }
    part.push_back(way[i]);
  }
  return part;
}

}  // namespace

std::vector<sim::Vector2> places_to_look_from(const WayMap& ways, double spacing_m) {
  const sim::Raster& map = ways.places();
  const int every = std::max(1, static_cast<int>(std::lround(spacing_m / map.resolution_m)));
  // The middle of what is passable in each square, so that narrow places have theirs.
  std::vector<sim::Vector2> places;
  for (int y0 = 0; y0 < map.height; y0 += every) {
    for (int x0 = 0; x0 < map.width; x0 += every) {
      double nearest = HUGE_VAL;
      sim::Vector2 best(0.0, 0.0);
      for (int y = y0; y < std::min(y0 + every, map.height); ++y) {
        for (int x = x0; x < std::min(x0 + every, map.width); ++x) {
          const double off = std::hypot(x - x0 - 0.5 * (every - 1), y - y0 - 0.5 * (every - 1));
          if (map.at(x, y) != 0 && off < nearest) nearest = off, best = map.center(x, y);
        }
      }
      if (std::isfinite(nearest)) places.push_back(best);
    }
  }
  return places;
}

double way_until_m(const Sight& sight, std::span<const std::vector<Look>> robots, std::size_t wanted) {
  std::vector<Look> all;
  for (const std::vector<Look>& looks : robots) all.insert(all.end(), looks.begin(), looks.end());
  std::stable_sort(all.begin(), all.end(), [](const Look& a, const Look& b) { return a.way_m < b.way_m; });
  CellSet seen(sight.cells());
  for (const Look& look : all) {
    seen |= sight.from(look.at);
    if (seen.size() >= wanted) return look.way_m;
  }
  return HUGE_VAL;
}

std::vector<std::size_t> greedy_cover(std::span<const CellSet> seen, std::size_t cells_wanted,
                                      std::span<const double> cost) {
  if (seen.empty()) return {};
  std::vector<std::size_t> chosen{0};
  CellSet covered = seen.front();
  std::size_t n = covered.size();
  const auto worth = [&](std::size_t cells, std::size_t set) {
    return static_cast<double>(cells) / (cost.empty() ? 1.0 : cost[set]);
  };
  // What a set adds only falls: it is counted again when its turn comes (Minoux 1978).
  std::priority_queue<std::pair<double, std::size_t>> gains;
  for (std::size_t i = 1; i < seen.size(); ++i) gains.emplace(worth(seen[i].beyond(covered), i), i);
  while (n < cells_wanted && !gains.empty()) {
    const std::size_t set = gains.top().second;
    gains.pop();
    const std::size_t adds = seen[set].beyond(covered);
    if (adds == 0) continue;
    if (!gains.empty() && worth(adds, set) < gains.top().first) {
      gains.emplace(worth(adds, set), set);
      continue;
    }
    covered |= seen[set];
    n += adds;
    chosen.push_back(set);
  }
  return chosen;
}

namespace {

/// What stays the same for all shares of one building.
struct Search {
  const BoundInput& input;
  const BoundParams& params;
  const WayMap& ways;
  const Sight& sight;
  std::vector<sim::Vector2> places;
  std::vector<CellSet> seen;        ///< from the places
  std::vector<CellSet> candidates;  ///< the same, behind what is seen from the starts at once
  std::vector<double> far_costs;    ///< of the candidates
};

Search search_of(const BoundInput& input, const BoundParams& params, const WayMap& ways, const Sight& sight) {
  constexpr double kNear_m = 5.0;  // what is nearer costs hardly less
  Search search{input, params, ways, sight, places_to_look_from(ways, params.spacing_m), {}, {}, {1.0}};
  // What is seen from where the robots are needs no stop.
  search.candidates.emplace_back(sight.cells());
  for (const sim::Vector2& start : input.starts) search.candidates.front() |= sight.from(start);
  const WayMap::Field from_start = ways.field_to(input.starts);
  for (const sim::Vector2& place : search.places) {
    search.seen.push_back(sight.from(place));
    search.candidates.push_back(search.seen.back());
    search.far_costs.push_back(std::sqrt(kNear_m + std::min(ways.distance_m(from_start, place), 1e6)));
  }
  return search;
}

/// The tours of one cover by the first `robots`, if they need less way than those that are there.
void try_tours(const Search& search, Legs& legs, const std::vector<std::size_t>& stops, std::size_t robots,
               std::size_t wanted, ShareBound& best, std::vector<Way>& best_ways) {
  std::vector<std::size_t> starts(robots);
  std::iota(starts.begin(), starts.end(), std::size_t{0});
  const Tours tours = tours_of(legs, starts, stops, search.sight.cells(), wanted);
  std::vector<std::vector<Look>> looks;
  for (std::size_t r = 0; r < robots; ++r) looks.push_back(legs.looks(r, tours[r]));
  const double way_m = way_until_m(search.sight, looks, wanted);
  if (way_m >= best.way_m) return;
  best.way_m = way_m;
  best.own_motion_s = 0.0;
  best_ways.assign(search.input.starts.size(), {});
  for (std::size_t r = 0; r < robots; ++r) {
    best_ways[r] = first_part(legs.whole_way(r, tours[r]), way_m);
    best.own_motion_s = std::max(best.own_motion_s, drive_time_s(best_ways[r], search.input.limits));
  }
}

}  // namespace

Bound find_bound(const BoundInput& input, const BoundParams& params) {
  const WayMap ways(*input.poses);
  const Sight sight(*input.world, *input.visible, params.sight);
  const Search search = search_of(input, params, ways, sight);
  Bound bound;
  for (std::size_t s = 0; s < kBoundShares.size(); ++s) {
    const auto wanted =
        static_cast<std::size_t>(std::ceil(kBoundShares[s] * static_cast<double>(sight.cells())));
    ShareBound& share = bound.shares[s];
    share.way_m = HUGE_VAL;
    for (const std::span<const double> costs :
         {std::span<const double>(), std::span<const double>(search.far_costs)}) {
      std::vector<sim::Vector2> nodes = input.starts;
      std::vector<std::size_t> stops;
      for (const std::size_t chosen : greedy_cover(search.candidates, wanted, costs)) {
        if (chosen == 0) continue;
        stops.push_back(nodes.size());
        nodes.push_back(search.places[chosen - 1]);
      }
      Legs legs(ways, sight, nodes, params.look_m);
      // The others may stand: in a small building a second robot is of no use to the tours that are found.
      for (std::size_t robots = 1; robots <= input.starts.size(); ++robots)
        try_tours(search, legs, stops, robots, wanted, share, bound.ways);
    }
    share.lower_m = lower_bound_m(kBoundShares[s], ways, sight, search.places, search.seen, input.starts,
                                  params.spacing_m);
    share.full_speed_s = share.way_m / input.limits.v_max_mps;
    share.lower_s = share.lower_m / input.limits.v_max_mps;
    bound.is_feasible = std::isfinite(share.way_m);
  }
  return bound;
}

}  // namespace topo::bench::bound

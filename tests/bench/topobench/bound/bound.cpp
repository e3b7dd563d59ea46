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
constexpr double kPlannedMore = 0.003;

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

double way_until_m(const Sight& sight, std::span<const Way> ways, std::size_t wanted, double look_m) {
  std::vector<std::vector<sim::Vector2>> looks;
  std::size_t most = 0;
  for (const Way& way : ways) {
    looks.emplace_back();
    double left_m = 0.0;  // to the next look
    for (std::size_t i = 1; i < way.size(); ++i) {
      const sim::Vector2 leg = way[i] - way[i - 1];
      const double leg_m = leg.norm();
      for (; left_m < leg_m; left_m += look_m) looks.back().push_back(way[i - 1] + leg * (left_m / leg_m));
      left_m -= leg_m;
    }
    if (!way.empty()) looks.back().push_back(way.back());
    most = std::max(most, looks.back().size());
  }
  CellSet seen(sight.cells());
  double longest = 0.0;
  for (const Way& way : ways) longest = std::max(longest, length_m(way));
  for (std::size_t k = 0; k < most; ++k) {
    for (const std::vector<sim::Vector2>& robot : looks) {
      if (k < robot.size()) seen |= sight.from(robot[k]);
    }
    if (seen.size() >= wanted) return std::min(longest, static_cast<double>(k) * look_m);
  }
  return HUGE_VAL;
}

std::vector<std::size_t> greedy_cover(std::span<const CellSet> seen, std::size_t cells_wanted) {
  std::vector<std::size_t> chosen;
  if (seen.empty()) return chosen;
  CellSet covered = seen.front();
  for (const CellSet& set : seen) covered |= set;
  const std::size_t all = covered.size();
  covered = CellSet(seen.front());
  chosen.push_back(0);
  // What a set adds only falls: it is counted again when its turn comes (Minoux 1978).
  std::priority_queue<std::pair<std::size_t, std::size_t>> gains;
  for (std::size_t i = 1; i < seen.size(); ++i) gains.emplace(seen[i].beyond(covered), i);
  std::size_t n = covered.size();
  while (n < std::min(all, cells_wanted) && !gains.empty()) {
    const auto [gain, set] = gains.top();
    gains.pop();
    const std::size_t now = seen[set].beyond(covered);
    if (!gains.empty() && now < gains.top().first) {
      gains.emplace(now, set);
      continue;
    }
    if (now == 0) break;
    covered |= seen[set];
    n += now;
    chosen.push_back(set);
  }
  return chosen;
}

Bound find_bound(const BoundInput& input, const BoundParams& params) {
  const WayMap ways(*input.poses);
  const Sight sight(*input.world, *input.visible, params.sight);
  const std::vector<sim::Vector2> places = places_to_look_from(ways, params.spacing_m);
  std::vector<CellSet> seen;
  seen.reserve(places.size());
  for (const sim::Vector2& place : places) seen.push_back(sight.from(place));
  // What is seen from where the robots are needs no stop.
  CellSet at_once(sight.cells());
  for (const sim::Vector2& start : input.starts) at_once |= sight.from(start);
  std::vector<CellSet> candidates{at_once};
  candidates.insert(candidates.end(), seen.begin(), seen.end());
  std::vector<std::size_t> starts(input.starts.size());
  std::iota(starts.begin(), starts.end(), std::size_t{0});
  Bound bound;
  for (std::size_t s = 0; s < kBoundShares.size(); ++s) {
    const auto cells_of = [&](double share) {
      return static_cast<std::size_t>(std::ceil(std::min(share, 1.0) * static_cast<double>(sight.cells())));
    };
    const std::size_t wanted = cells_of(kBoundShares[s]);
    // A little more is planned for: looks on a whole way are not at the places where those on its legs were.
    const std::size_t planned = cells_of(kBoundShares[s] + kPlannedMore);
    std::vector<sim::Vector2> nodes = input.starts;
    std::vector<std::size_t> stops;
    for (const std::size_t chosen : greedy_cover(candidates, planned)) {
      if (chosen == 0) continue;
      stops.push_back(nodes.size());
      nodes.push_back(places[chosen - 1]);
    }
    Legs legs(ways, sight, nodes, params.look_m);
    const Tours tours = tours_of(legs, starts, stops, sight.cells(), planned);
    std::vector<Way> driven;
    for (std::size_t r = 0; r < tours.size(); ++r) driven.push_back(legs.whole_way(starts[r], tours[r]));
    ShareBound& share = bound.shares[s];
    share.way_m = way_until_m(sight, driven, wanted, params.look_m);
    share.lower_m = lower_bound_m(kBoundShares[s], ways, sight, places, seen, input.starts, params.spacing_m);
    share.full_speed_s = share.way_m / input.limits.v_max_mps;
    share.lower_s = share.lower_m / input.limits.v_max_mps;
    for (const Way& way : driven)
      share.own_motion_s =
          std::max(share.own_motion_s, drive_time_s(first_part(way, share.way_m), input.limits));
    bound.ways = std::move(driven);
    bound.is_feasible = std::isfinite(share.way_m);
  }
  return bound;
}

}  // namespace topo::bench::bound

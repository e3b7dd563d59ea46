// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/greedy_cover.hpp"

#include <algorithm>
#include <cassert>

#include "core/goals/filters.hpp"

namespace topo::goals {
namespace {

/// The expected information gain of each viewpoint.
class Hopes {
 public:
  Hopes(std::span<const Prospect> prospects, std::span<const StandingPlace> places)
      : prospects_(prospects),
        places_(places),
        hope_(places.size(), 0.0),
        served_from_(prospects.size()),
        served_(prospects.size(), false) {
    for (std::uint32_t p = 0; p < places.size(); ++p) {
      for (const std::uint32_t k : places[p].serves) {
        hope_[p] += prospects[k].chance;
        served_from_[k].push_back(p);
      }
    }
  }

  /// Precondition: there is at least one viewpoint.
  [[nodiscard]] std::uint32_t best() const {
    std::uint32_t best = 0;
    for (std::uint32_t p = 1; p < hope_.size(); ++p)
      if (is_better(p, best)) best = p;
    return best;
  }
  [[nodiscard]] double at(std::uint32_t place) const { return hope_[place]; }
  [[nodiscard]] const std::vector<bool>& served() const { return served_; }
  void give_up(std::uint32_t place) { hope_[place] = -HUGE_VAL; }

  /// Marks all openings of a viewpoint as served. Returns the likeliest that was not served before.
  std::uint32_t choose(std::uint32_t place) {
    std::uint32_t likeliest = 0;
    double most = -1.0;
    for (const std::uint32_t k : places_[place].serves) {
      if (served_[k]) continue;
      served_[k] = true;
      for (const std::uint32_t p : served_from_[k]) hope_[p] -= prospects_[k].chance;
      if (prospects_[k].chance <= most) continue;
      likeliest = k;
      most = prospects_[k].chance;
    }
    return likeliest;
  }

 private:
  /// The tolerance covers rounding: sums of equal chances may differ by their order.
  [[nodiscard]] bool is_better(std::uint32_t a, std::uint32_t b) const {
    constexpr double kSame = 1e-9;
    if (hope_[a] > hope_[b] + kSame) return true;
    return hope_[a] > hope_[b] - kSame && places_[a].away_m < places_[b].away_m;
  }

  std::span<const Prospect> prospects_;
  std::span<const StandingPlace> places_;
  std::vector<double> hope_;
  std::vector<std::vector<std::uint32_t>> served_from_;  ///< the viewpoints that serve each prospect
  std::vector<bool> served_;
};

}  // namespace

GreedyCover cover_openings(std::span<const Prospect> prospects, std::span<const StandingPlace> places,
                           std::span<const std::vector<types::Vector2>> visited, const GoalParams& params) {
  assert(params.worth_min > 0.0);
  GreedyCover cover;
  Hopes hopes(prospects, places);
  while (!places.empty()) {
    const std::uint32_t best = hopes.best();
    if (hopes.at(best) < params.worth_min) break;
    const StandingPlace& place = places[best];
    if (place.is_shared && distance_from_paths_m(place.p_map, visited) < params.visited_radius_m)
      hopes.give_up(best);
    else
      cover.chosen.push_back({best, hopes.choose(best)});
  }
  cover.served = hopes.served();
  return cover;
}

}  // namespace topo::goals

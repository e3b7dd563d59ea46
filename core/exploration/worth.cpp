// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/worth.hpp"

#include <cassert>
#include <cmath>

namespace topo::exploration {
namespace {

/// Goals `first` to `last` of a tour.
struct Stretch {
  std::size_t first = 0, last = 0;
  double loss_s = 0.0;  ///< time beyond what the gain is worth
};

/// A goal beside a tour, before the goal at `at`.
struct Detour {
  std::size_t at = 0;
  double time_s = HUGE_VAL;
};

class Round {
 public:
  Round(const TourGoals& goals, const Tour& tour, double home_m)
      : goals_(goals), tour_(tour), home_m_(home_m) {}

  /// From the goal before position `at` of the tour, or the robot, to the goal at `to`, or home.
  [[nodiscard]] double way_m(std::size_t at, std::size_t to) const {
    if (at == 0) return to == tour_.size() ? home_m_ : goals_.from_start_m[tour_[to]];
    const std::size_t from = tour_[at - 1];
    return to == tour_.size() ? goals_.to_home_m[from] : goals_.between(from, tour_[to]);
  }

  /// The cheapest place for a goal that is not in the tour.
  [[nodiscard]] Detour cheapest(std::size_t goal, const WorthParams& params) const {
    Detour cheapest;
    for (std::size_t at = 0; at <= tour_.size(); ++at) {
      const double to_m = at == 0 ? goals_.from_start_m[goal] : goals_.between(tour_[at - 1], goal);
      const double on_m = at == tour_.size() ? goals_.to_home_m[goal] : goals_.between(goal, tour_[at]);
      const double time_s = (to_m + on_m - way_m(at, at)) / params.speed_mps + params.stop_s;
      if (time_s < cheapest.time_s) cheapest = {at, time_s};
    }
    return cheapest;
  }

  [[nodiscard]] Stretch worst(std::span<const double> gain_m2, const WorthParams& params) const {
    Stretch worst;
    for (std::size_t first = 0; first < tour_.size(); ++first) {
      double driven_m = way_m(first, first), gained_m2 = 0.0, stops_s = 0.0;
      for (std::size_t last = first; last < tour_.size(); ++last) {
        if (last > first) driven_m += way_m(last, last);
        gained_m2 += gain_m2[tour_[last]];
        stops_s += params.stop_s;
        const double saved_m = driven_m + way_m(last + 1, last + 1) - way_m(first, last + 1);
        const double time_s = saved_m / params.speed_mps + stops_s;
        const double loss_s = time_s - gained_m2 / params.rate_m2ps;
        if (loss_s > worst.loss_s) worst = {first, last, loss_s};
      }
    }
    return worst;
  }

 private:
  const TourGoals& goals_;
  const Tour& tour_;
  double home_m_;
};

/// Takes those goals into the tour again that are worth the detour from what is left of it, the best first: a
/// stretch is left out as a whole, with what is good in it.
void take_again(const TourGoals& goals, std::span<const double> gain_m2, double home_m,
                const WorthParams& params, Tour& tour, std::vector<std::size_t>& out) {
  while (true) {
    auto best = out.end();
    std::size_t best_at = 0;
    double best_s = 0.0;
    for (auto goal = out.begin(); goal != out.end(); ++goal) {
      const Detour detour = Round(goals, tour, home_m).cheapest(*goal, params);
      const double saved_s = gain_m2[*goal] / params.rate_m2ps - detour.time_s;
      if (saved_s <= best_s) continue;
      best = goal;
      best_at = detour.at;
      best_s = saved_s;
    }
    if (best == out.end()) return;
    tour.insert(tour.begin() + static_cast<std::ptrdiff_t>(best_at), *best);
    out.erase(best);
  }
}

}  // namespace

std::vector<LeftOut> not_worth_it(const TourGoals& goals, std::span<const double> gain_m2, double home_m,
                                  const WorthParams& params) {
  assert(gain_m2.size() == goals.count);
  std::vector<std::size_t> out;
  constexpr double kLengthAlone = 1.0;
  Tour tour = cheap_tour(goals, kLengthAlone);
  while (!tour.empty()) {
    const Stretch worst = Round(goals, tour, home_m).worst(gain_m2, params);
    if (!(worst.loss_s > 0.0)) break;
    const auto first = tour.begin() + static_cast<std::ptrdiff_t>(worst.first);
    const auto end = tour.begin() + static_cast<std::ptrdiff_t>(worst.last + 1);
    out.insert(out.end(), first, end);
    tour.erase(first, end);
  }
  take_again(goals, gain_m2, home_m, params, tour, out);
  const Round kept(goals, tour, home_m);
  std::vector<LeftOut> left_out;
  left_out.reserve(out.size());
  for (const std::size_t goal : out)
    left_out.push_back({goal, gain_m2[goal], kept.cheapest(goal, params).time_s});
  return left_out;
}

}  // namespace topo::exploration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/worth.hpp"

#include <cassert>

namespace topo::exploration {
namespace {

/// Goals `first` to `last` of a tour.
struct Stretch {
  std::size_t first = 0, last = 0;
  double gain_m2 = 0.0, time_s = 0.0;
  double loss_s = 0.0;  ///< time beyond what the gain is worth
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
        if (loss_s > worst.loss_s) worst = {first, last, gained_m2, time_s, loss_s};
      }
    }
    return worst;
  }

 private:
  const TourGoals& goals_;
  const Tour& tour_;
  double home_m_;
};

}  // namespace

std::vector<LeftOut> not_worth_it(const TourGoals& goals, std::span<const double> gain_m2, double home_m,
                                  const WorthParams& params) {
  assert(gain_m2.size() == goals.count);
  std::vector<LeftOut> out;
  constexpr double kLengthAlone = 1.0;
  Tour tour = cheap_tour(goals, kLengthAlone);
  while (!tour.empty()) {
    const Stretch worst = Round(goals, tour, home_m).worst(gain_m2, params);
    if (!(worst.loss_s > 0.0)) break;
    const auto first = tour.begin() + static_cast<std::ptrdiff_t>(worst.first);
    const auto end = tour.begin() + static_cast<std::ptrdiff_t>(worst.last + 1);
    for (auto goal = first; goal != end; ++goal) out.push_back({*goal, worst.gain_m2, worst.time_s});
    tour.erase(first, end);
  }
  return out;
}

}  // namespace topo::exploration

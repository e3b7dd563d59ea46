// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/tour.hpp"

#include <algorithm>
#include <numeric>

namespace topo::exploration {
namespace {

constexpr double kLeastGain_m = 1e-6;  // a smaller gain is rounding, and the search would not end
constexpr std::size_t kPieceMax = 3;   // as in the method (Or 1976): longer pieces cost time and gain little

Tour by_nearest(const TourGoals& goals, std::optional<std::size_t> first) {
  Tour tour(goals.count);
  std::iota(tour.begin(), tour.end(), std::size_t{0});
  if (first) std::swap(tour[0], tour[*first]);
  for (std::size_t i = first ? 1 : 0; i < tour.size(); ++i) {
    const auto way_m = [&](std::size_t goal) {
      return i == 0 ? goals.from_start_m[goal] : goals.between(tour[i - 1], goal);
    };
    const auto rest = tour.begin() + static_cast<std::ptrdiff_t>(i);
    std::iter_swap(rest, std::min_element(rest, tour.end(), [&](std::size_t a, std::size_t b) {
                     return way_m(a) != way_m(b) ? way_m(a) < way_m(b) : a < b;
                   }));
  }
  return tour;
}

/// The best tour so far, and a trial that may be better.
class Search {
 public:
  Search(const TourGoals& goals, double length_share, Tour first)
      : goals_(goals), length_share_(length_share), best_(std::move(first)), best_m_(cost_m(best_)) {}

  [[nodiscard]] const Tour& best() const { return best_; }

  bool turn_pieces(std::size_t from) {
    bool better = false;
    for (std::size_t i = from; i + 1 < best_.size(); ++i) {
      for (std::size_t j = i + 1; j < best_.size(); ++j) {
        trial_ = best_;
        std::reverse(at(trial_, i), at(trial_, j + 1));
        better = take_if_better() || better;
      }
    }
    return better;
  }

  bool move_pieces(std::size_t from) {
    bool better = false;
    for (std::size_t length = 1; length <= kPieceMax; ++length) {
      for (std::size_t i = from; i + length <= best_.size(); ++i) {
        for (std::size_t to = from; to + length <= best_.size(); ++to) {
          if (to == i) continue;
          trial_ = best_;
          if (to < i)
            std::rotate(at(trial_, to), at(trial_, i), at(trial_, i + length));
          else
            std::rotate(at(trial_, i), at(trial_, i + length), at(trial_, to + length));
          better = take_if_better() || better;
        }
      }
    }
    return better;
  }

 private:
  static Tour::iterator at(Tour& tour, std::size_t i) {
    return tour.begin() + static_cast<std::ptrdiff_t>(i);
  }
  [[nodiscard]] double cost_m(const Tour& tour) const { return tour_cost_m(goals_, tour, length_share_); }
  bool take_if_better() {
    const double trial_m = cost_m(trial_);
    if (!(trial_m < best_m_ - kLeastGain_m)) return false;
    best_.swap(trial_);
    best_m_ = trial_m;
    return true;
  }

  const TourGoals& goals_;
  double length_share_;
  Tour best_, trial_;
  double best_m_;
};

}  // namespace

double tour_cost_m(const TourGoals& goals, const Tour& tour, double length_share) {
  double driven_m = 0.0, waited_m = 0.0, worth = 0.0;
  for (std::size_t i = 0; i < tour.size(); ++i) {
    driven_m += i == 0 ? goals.from_start_m[tour[0]] : goals.between(tour[i - 1], tour[i]);
    waited_m += goals.worth[tour[i]] * driven_m;
    worth += goals.worth[tour[i]];
  }
  const double mean_m = worth > 0.0 ? waited_m / worth : driven_m;
  if (!tour.empty()) driven_m += goals.to_home_m[tour.back()];
  return length_share * driven_m + (1.0 - length_share) * mean_m;
}

Tour cheap_tour(const TourGoals& goals, double length_share, std::optional<std::size_t> first) {
  Search search(goals, length_share, by_nearest(goals, first));
  const std::size_t from = first ? 1 : 0;
  for (bool better = true; better;) {
    better = search.turn_pieces(from);
    better = search.move_pieces(from) || better;
  }
  return search.best();
}

}  // namespace topo::exploration

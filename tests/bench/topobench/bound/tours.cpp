// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/bound/tours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace topo::bench::bound {
namespace {

constexpr double kGain_m = 1e-6;
constexpr int kRoundsMax = 200;

/// Longest first, then all together.
struct Worth {
  double longest_m = 0.0, sum_m = 0.0;
  [[nodiscard]] bool better_than(const Worth& other) const {
    if (longest_m < other.longest_m - kGain_m) return true;
    return longest_m < other.longest_m + kGain_m && sum_m < other.sum_m - kGain_m;
  }
};

class Sharing {
 public:
  Sharing(const Lengths& lengths, const std::vector<std::size_t>& starts)
      : lengths_(lengths), starts_(starts), tours_(starts.size()), tour_m_(starts.size(), 0.0) {}

  /// The stop that is farthest from all tours first, where it costs least.
  void insert_all(std::vector<std::size_t> stops) {
    std::sort(stops.begin(), stops.end(), [&](std::size_t a, std::size_t b) {
      return lengths_[starts_.front()][a] > lengths_[starts_.front()][b];
    });
    for (const std::size_t stop : stops) insert_best(stop);
  }
  void improve() {
    for (int round = 0; round < kRoundsMax; ++round) {
      if (!turn_parts() && !move_stops()) return;
    }
  }
  Tours take() { return std::move(tours_); }

 private:
  [[nodiscard]] double length_of(std::size_t robot, const std::vector<std::size_t>& stops) const {
    return open_length_m(lengths_, starts_[robot], stops);
  }
  [[nodiscard]] Worth worth() const {
    Worth worth;
    for (const double m : tour_m_) {
      worth.longest_m = std::max(worth.longest_m, m);
      worth.sum_m += m;
    }
    return worth;
  }
  /// Of two changed tours.
  [[nodiscard]] Worth worth_with(std::size_t a, double a_m, std::size_t b, double b_m) const {
    Worth worth;
    for (std::size_t i = 0; i < tour_m_.size(); ++i) {
      const double m = i == a ? a_m : i == b ? b_m : tour_m_[i];
      worth.longest_m = std::max(worth.longest_m, m);
      worth.sum_m += m;
    }
    return worth;
  }
  void set(std::size_t robot, std::vector<std::size_t> stops) {
    tour_m_[robot] = length_of(robot, stops);
    tours_[robot] = std::move(stops);
  }
  [[nodiscard]] std::size_t node(std::size_t robot, const std::vector<std::size_t>& stops,
                                 std::size_t at) const {
    return at == 0 ? starts_[robot] : stops[at - 1];
  }
  /// More way when a stop comes before position `at`.
  [[nodiscard]] double detour_m(std::size_t robot, const std::vector<std::size_t>& stops, std::size_t at,
                                std::size_t stop) const {
    const std::size_t before = node(robot, stops, at);
    if (at == stops.size()) return lengths_[before][stop];
    return lengths_[before][stop] + lengths_[stop][stops[at]] - lengths_[before][stops[at]];
  }
  [[nodiscard]] std::pair<std::size_t, double> best_place(std::size_t robot,
                                                          const std::vector<std::size_t>& stops,
                                                          std::size_t stop) const {
    std::pair<std::size_t, double> best{0, HUGE_VAL};
    for (std::size_t at = 0; at <= stops.size(); ++at) {
      if (const double m = detour_m(robot, stops, at, stop); m < best.second) best = {at, m};
    }
    return best;
  }

  void insert_best(std::size_t stop) {
    std::size_t robot = 0, at = 0;
    Worth best{HUGE_VAL, HUGE_VAL};
    for (std::size_t r = 0; r < tours_.size(); ++r) {
      const auto [place, more_m] = best_place(r, tours_[r], stop);
      const Worth w = worth_with(r, tour_m_[r] + more_m, r, tour_m_[r] + more_m);
      if (w.better_than(best)) best = w, robot = r, at = place;
    }
    std::vector<std::size_t> stops = tours_[robot];
    stops.insert(stops.begin() + static_cast<std::ptrdiff_t>(at), stop);
    set(robot, std::move(stops));
  }

  /// 2-opt, within a tour.
  bool turn_parts() {
    bool any = false;
    for (std::size_t r = 0; r < tours_.size(); ++r) {
      for (std::size_t i = 0; i < tours_[r].size(); ++i) {
        for (std::size_t k = i + 1; k < tours_[r].size(); ++k) {
          const auto& t = tours_[r];
          const std::size_t before = node(r, t, i);
          double gain_m = lengths_[before][t[i]] - lengths_[before][t[k]];
          if (k + 1 < t.size()) gain_m += lengths_[t[k]][t[k + 1]] - lengths_[t[i]][t[k + 1]];
          if (!(gain_m > kGain_m)) continue;
          std::vector<std::size_t> turned = t;
          std::reverse(turned.begin() + static_cast<std::ptrdiff_t>(i),
                       turned.begin() + static_cast<std::ptrdiff_t>(k) + 1);
          set(r, std::move(turned));
          any = true;
        }
      }
    }
    return any;
  }

  /// One to three stops in a row, to their best place in any tour.
  bool move_stops() {
    for (std::size_t from = 0; from < tours_.size(); ++from) {
      for (std::size_t n = 1; n <= 3; ++n) {
        for (std::size_t i = 0; i + n <= tours_[from].size(); ++i) {
          if (move_part(from, i, n)) return true;
        }
      }
    }
    return false;
  }
  bool move_part(std::size_t from, std::size_t i, std::size_t n) {
    const auto first = tours_[from].begin() + static_cast<std::ptrdiff_t>(i),
               last = first + static_cast<std::ptrdiff_t>(n);
    const std::vector<std::size_t> part(first, last);
    std::vector<std::size_t> rest = tours_[from];
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i),
               rest.begin() + static_cast<std::ptrdiff_t>(i + n));
    const Worth now = worth();
    for (std::size_t to = 0; to < tours_.size(); ++to) {
      const std::vector<std::size_t>& base = to == from ? rest : tours_[to];
      for (std::size_t at = 0; at <= base.size(); ++at) {
        for (const bool turned : {false, true}) {
          std::vector<std::size_t> with = base;
          if (turned)
            with.insert(with.begin() + static_cast<std::ptrdiff_t>(at), part.rbegin(), part.rend());
          else
            with.insert(with.begin() + static_cast<std::ptrdiff_t>(at), part.begin(), part.end());
          const double with_m = length_of(to, with), rest_m = to == from ? with_m : length_of(from, rest);
          if (!worth_with(to, with_m, from, rest_m).better_than(now)) continue;
          if (to != from) set(from, rest);
          set(to, std::move(with));
          return true;
        }
      }
    }
    return false;
  }

  const Lengths& lengths_;
  const std::vector<std::size_t>& starts_;
  Tours tours_;
  std::vector<double> tour_m_;
};

}  // namespace

double open_length_m(const Lengths& lengths, std::size_t start, const std::vector<std::size_t>& stops) {
  double sum = 0.0;
  for (const std::size_t stop : stops) {
    sum += lengths[start][stop];
    start = stop;
  }
  return sum;
}

Tours share_out(const Lengths& lengths, const std::vector<std::size_t>& starts,
                const std::vector<std::size_t>& stops) {
  Sharing sharing(lengths, starts);
  sharing.insert_all(stops);
  sharing.improve();
  return sharing.take();
}

double spanning_tree_m(const Lengths& lengths, const std::vector<std::size_t>& nodes) {
  std::vector<double> nearest(nodes.size(), HUGE_VAL);
  std::vector<bool> joined(nodes.size(), false);
  double sum = 0.0;
  if (!nodes.empty()) nearest[0] = 0.0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    std::size_t next = nodes.size();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!joined[i] && (next == nodes.size() || nearest[i] < nearest[next])) next = i;
    }
    joined[next] = true;
    sum += nearest[next];
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nearest[i] = std::min(nearest[i], lengths[nodes[next]][nodes[i]]);
  }
  return sum;
}

}  // namespace topo::bench::bound

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "core/team/assignment.hpp"
#include "core/team/status_message.hpp"

namespace topo::team::testing {

/// Points of a lattice, so that equal ones and equal distances are common. `step_m` beyond kSameGoal_m: each
/// point is a goal of its own.
inline std::vector<types::Vector2> arbitrary_points(int count_max, double step_m = 2.0) {
  std::vector<types::Vector2> points;
  for (int n = *rc::gen::inRange(0, count_max + 1); n > 0; --n)
    points.emplace_back(step_m * *rc::gen::inRange(-6, 7), step_m * *rc::gen::inRange(-6, 7));
  return points;
}

template <class T>
std::vector<T> shuffled(const std::vector<T>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(*rc::gen::arbitrary<unsigned>()));
  std::vector<T> out;
  for (const std::size_t i : order) out.push_back(values[i]);
  return out;
}

/// Whole metres, so that ties are common; one in four cannot get there.
inline double arbitrary_cost_m() {
  return *rc::gen::inRange(0, 4) == 0 ? HUGE_VAL : static_cast<double>(*rc::gen::inRange(1, 20));
}

/// Up to four robots and ten goals, in the order that a table wants.
inline CostTable arbitrary_table() {
  std::vector<std::uint16_t> robots;
  for (std::uint16_t id = 0; id < 4; ++id) {
    if (*rc::gen::arbitrary<bool>()) robots.push_back(id);
  }
  std::vector<types::Vector2> goals;
  for (int x = *rc::gen::inRange(0, 11); x > 0; --x) goals.emplace_back(3.0 * -x, *rc::gen::inRange(0, 9));
  CostTable table(robots, goals);
  for (std::size_t r = 0; r < robots.size(); ++r) {
    for (std::size_t g = 0; g < goals.size(); ++g) table.cost_m(r, g) = arbitrary_cost_m();
  }
  return table;
}

/// No goal twice, none that the robot cannot get to.
inline bool is_sound(const CostTable& table, const Assignment& assignment, bool shared = false) {
  std::vector<int> times(table.goals().size(), 0);
  for (std::size_t r = 0; r < assignment.size(); ++r) {
    if (!assignment[r]) continue;
    if (std::isinf(table.cost_m(r, *assignment[r]))) return false;
    if (++times[*assignment[r]] > 1 && !shared) return false;
  }
  return assignment.size() == table.robots().size();
}

}  // namespace topo::team::testing

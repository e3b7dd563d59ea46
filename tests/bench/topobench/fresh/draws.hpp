// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "tests/bench/topobench/fresh/floor_plan.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench::fresh {

/// The nearest whole number of cells.
inline double snapped(double metres) { return std::round(metres / kCell_m) * kCell_m; }
/// Uniform between two lengths, in whole cells.
inline double length_of(sim::Random& random, double low_m, double high_m) {
  return snapped(random.uniform(low_m, high_m));
}
inline bool happens(sim::Random& random, double probability) { return random.uniform() < probability; }
/// 0 to n - 1; n is 1 or more.
inline std::size_t one_of(sim::Random& random, std::size_t n) {
  return static_cast<std::size_t>(random.next() % n);
}

}  // namespace topo::bench::fresh

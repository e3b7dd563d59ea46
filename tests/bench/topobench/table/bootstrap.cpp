// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/sim/random.hpp"

namespace topo::bench {
namespace {

constexpr std::size_t kDrawings = 10000;
constexpr std::uint64_t kBootstrapSeed = 1;
constexpr std::size_t kTail = kDrawings / 40;  // 2.5 % on each side

}  // namespace

Interval bootstrap_95(std::span<const double> logs) {
  if (logs.size() < 2) return {0.0, HUGE_VAL};
  sim::Random random(kBootstrapSeed);
  std::vector<double> means;
  means.reserve(kDrawings);
  for (std::size_t i = 0; i < kDrawings; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < logs.size(); ++k) sum += logs[random.next() % logs.size()];
    means.push_back(sum / static_cast<double>(logs.size()));
  }
  std::sort(means.begin(), means.end());
  return {std::exp(means[kTail]), std::exp(means[kDrawings - 1 - kTail])};
}

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/paired_ratio.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <vector>

#include "tests/bench/topobench/table/bootstrap.hpp"

namespace topo::bench {
namespace {

/// Probability that |t| stays under the value: the finite sums of Abramowitz and Stegun 1964, 26.7.3 and
/// 26.7.4.
double student_within(double t, std::size_t degrees_of_freedom) {
  const auto n = static_cast<double>(degrees_of_freedom);
  const double angle = std::atan(t / std::sqrt(n));
  const double cosine = std::cos(angle), cosine2 = cosine * cosine;
  const bool odd = degrees_of_freedom % 2 == 1;
  double term = odd ? cosine : 1.0, sum = degrees_of_freedom == 1 ? 0.0 : term;
  for (std::size_t k = odd ? 3 : 2; k + 2 <= degrees_of_freedom; k += 2) {
    term *= cosine2 * static_cast<double>(k - 1) / static_cast<double>(k);
    sum += term;
  }
  const double even_part = std::sin(angle) * sum;
  return odd ? 2.0 / std::numbers::pi * (angle + even_part) : even_part;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Of the mean of logarithms, as ratios.
Interval interval_of(std::span<const double> logs) {
  if (logs.size() < 2) return {0.0, HUGE_VAL};
  const double middle = mean(logs);
  double squares = 0.0;
  for (const double log : logs) squares += (log - middle) * (log - middle);
  const auto n = static_cast<double>(logs.size());
  const double half = student_95(logs.size() - 1) * std::sqrt(squares / (n - 1.0) / n);
  return {std::exp(middle - half), std::exp(middle + half)};
}

}  // namespace

double student_95(std::size_t degrees_of_freedom) {
  // The widest there is, 12.706, is that of one degree of freedom.
  double low = 1.0, high = 13.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (student_within(middle, degrees_of_freedom) < 0.95 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

PairedRatio paired_ratio(std::span<const Pair> pairs) {
  PairedRatio out;
  out.pairs = pairs.size();
  std::vector<double> logs;
  std::map<std::string, std::vector<double>> by_world;
  for (const Pair& pair : pairs) {
    logs.push_back(std::log(pair.a / pair.b));
    by_world[pair.world].push_back(logs.back());
    if (pair.a < pair.b) ++out.a_less;
  }
  std::vector<double> means;
  for (const auto& [world, values] : by_world) means.push_back(mean(values));
  out.worlds = means.size();
  if (!logs.empty()) out.ratio = std::exp(mean(logs));
  out.over_runs = interval_of(logs);
  out.over_worlds = interval_of(means);
  out.bootstrap = bootstrap_95(means);
  return out;
}

}  // namespace topo::bench

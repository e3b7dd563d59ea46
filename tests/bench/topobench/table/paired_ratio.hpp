// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace topo::bench {

/// The same thing measured of two contenders under the same conditions. Both above 0.
struct Pair {
  std::string world;
  double a = 1.0;
  double b = 1.0;
};

struct Interval {
  double low = 0.0;
  double high = 0.0;  ///< infinite, and low 0, where one value alone says nothing of the spread
};

/// How a compares with b.
struct PairedRatio {
  std::size_t pairs = 0;
  std::size_t worlds = 0;
  std::size_t a_less = 0;  ///< pairs in which a is less than b
  double ratio = 1.0;      ///< geometric mean of a / b
  Interval over_runs;
  Interval over_worlds;
  Interval bootstrap;  ///< over worlds
};

/// Geometric mean of the ratios, and two 95 % intervals. Both are Student's t on the logarithms of the
/// ratios: times are positive, and what a contender or a building changes in them is a factor, so that
/// logarithms are near to normal and their mean more so.
/// - over_runs takes each pair for itself: what more seeds in these very worlds would give.
/// - over_worlds takes each world's mean as one value (as many degrees of freedom as there are worlds, less
///   one): runs in one building are alike, so this is what other buildings of the kind would give, and the
///   one to believe of a claim. It has the middle of the worlds' means, which is `ratio` when all worlds have
///   as many pairs.
/// - bootstrap takes the same means of worlds and no law of their spread (bootstrap.hpp): for suites of two
///   dozen buildings; of fewer it is narrower than it should be.
/// The order of the pairs matters by rounding alone. Without pairs: ratio 1, nothing known.
PairedRatio paired_ratio(std::span<const Pair> pairs);

/// The value that Student's t with so many degrees of freedom (1 or more) exceeds in size with a probability
/// of 5 %.
double student_95(std::size_t degrees_of_freedom);

}  // namespace topo::bench

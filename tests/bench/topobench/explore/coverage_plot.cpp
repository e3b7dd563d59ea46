// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/coverage_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace topo::bench {
namespace {

// The picture's "metres" are its pixels.
constexpr double kWidth = 800.0, kHeight = 400.0, kMargin = 40.0;
constexpr sim::Colour kLine{215, 215, 215};
constexpr sim::Colour kInk{60, 60, 60};

/// Digits of 3 x 5 pixels, rows from above, the left pixel in the highest bit.
constexpr std::array<std::array<unsigned, 5>, 10> kDigits{{{7, 5, 5, 5, 7},
                                                           {2, 6, 2, 2, 7},
                                                           {7, 1, 7, 4, 7},
                                                           {7, 1, 7, 1, 7},
                                                           {5, 5, 7, 1, 1},
                                                           {7, 4, 7, 1, 7},
                                                           {7, 4, 7, 5, 7},
                                                           {7, 1, 1, 1, 1},
                                                           {7, 5, 7, 5, 7},
                                                           {7, 5, 7, 1, 7}}};

void number(sim::Picture& picture, double x, double y, int value) {
  for (const char digit : std::to_string(value)) {
    const auto& rows = kDigits[static_cast<std::size_t>(digit - '0')];
    for (int row = 0; row < 5; ++row) {
      for (int column = 0; column < 3; ++column) {
        if ((rows[static_cast<std::size_t>(row)] >> static_cast<unsigned>(2 - column) & 1U) == 0) continue;
        for (const double dx : {0.5, 1.5}) {
          for (const double dy : {0.5, 1.5}) picture.dot({x + 2 * column + dx, y - 2 * row - dy}, kInk);
        }
      }
    }
    x += 8.0;
  }
}

double time_step(double end_s) {
  for (const double step : {10.0, 30.0, 60.0, 120.0, 300.0}) {
    if (end_s / step <= 12.0) return step;
  }
  return 600.0;
}

}  // namespace

sim::Picture coverage_plot(const RunResult& result) {
  types::Rectangle area;
  area.extend({0.0, 0.0});
  area.extend({kWidth, kHeight});
  sim::Picture picture(area, 1.0);
  const double end_s = std::max(result.end_s, 1.0);
  const auto place = [&](double t_s, double share) {
    return types::Vector2(kMargin + (kWidth - 2 * kMargin) * t_s / end_s,
                          kMargin + (kHeight - 2 * kMargin) * share);
  };
  for (const double share : {0.0, 0.5, 0.9, 0.95, 0.99, 1.0}) {
    picture.line(place(0.0, share), place(end_s, share), kLine);
    if (share != 0.95 && share != 0.99)
      number(picture, 8.0, place(0.0, share).y() + 5.0, static_cast<int>(100 * share));
  }
  for (double t_s = 0.0; t_s <= end_s; t_s += time_step(end_s)) {
    picture.line(place(t_s, 0.0), place(t_s, 1.0), kLine);
    number(picture, place(t_s, 0.0).x() - 8.0, kMargin - 10.0, static_cast<int>(t_s));
  }
  types::Vector2 before = place(0.0, 0.0);
  for (const auto& [t_s, share] : result.coverage) {
    const types::Vector2 p = place(t_s, share);
    picture.line(before, p, sim::kTruthInk);
    before = p;
  }
  return picture;
}

}  // namespace topo::bench

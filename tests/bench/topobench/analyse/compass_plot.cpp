// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/compass_plot.hpp"

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"

namespace topo::bench {
namespace {

constexpr int kPixelsADegree = 5, kCurveHeight = 320, kCurveMargin = 20, kHalfTurn = 180;
constexpr daemon::Rgb kPaper{255, 255, 255}, kGrid{215, 215, 215}, kCurve{30, 60, 220}, kFound{220, 30, 30};

int column(double degrees) { return kCurveMargin + static_cast<int>(std::lround(degrees * kPixelsADegree)); }

}  // namespace

daemon::Picture compass_plot(const compass::Compass& compass) {
  daemon::Picture plot(2 * kCurveMargin + kHalfTurn * kPixelsADegree, kCurveHeight + 2 * kCurveMargin,
                       kPaper);
  for (int degrees = 0; degrees <= kHalfTurn; degrees += 10)
    plot.line(column(degrees), kCurveMargin, column(degrees), kCurveMargin + kCurveHeight, kGrid);
  if (compass.angle_rad) {
    const double degrees = *compass.angle_rad / types::kDegree_rad;
    for (const double at : {degrees, degrees + 90.0})
      plot.line(column(at), kCurveMargin, column(at), kCurveMargin + kCurveHeight, kFound);
  }
  if (compass.entropy.empty()) return plot;
  const auto [low, high] = std::minmax_element(compass.entropy.begin(), compass.entropy.end());
  const double range = std::max(*high - *low, 1e-9);
  const auto steps = compass.entropy.size();
  const auto row = [&](std::size_t i) {
    return kCurveMargin +
           static_cast<int>(std::lround(kCurveHeight * (*high - compass.entropy[i % steps]) / range));
  };
  const double step_degrees = 90.0 / static_cast<double>(steps);
  for (std::size_t i = 0; i < 2 * steps; ++i) {
    const int x = column(static_cast<double>(i) * step_degrees);
    const int next = column(static_cast<double>(i + 1) * step_degrees);
    for (int thick = 0; thick < 2; ++thick) plot.line(x, row(i) + thick, next, row(i + 1) + thick, kCurve);
  }
  return plot;
}

}  // namespace topo::bench

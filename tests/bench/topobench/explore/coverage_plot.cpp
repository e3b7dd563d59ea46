// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/coverage_plot.hpp"

#include <algorithm>
#include <string>

#include "tests/bench/topobench/explore/plot_text.hpp"

namespace topo::bench {
namespace {

// The picture's "metres" are its pixels.
constexpr double kWidth = 800.0, kHeight = 400.0, kMargin = 40.0;
constexpr double kLegendWidth = 300.0, kLegendLine = 18.0;
constexpr sim::Colour kLine{215, 215, 215};
constexpr sim::Colour kInk{60, 60, 60};

sim::Picture empty_picture() {
  types::Rectangle area;
  area.extend({0.0, 0.0});
  area.extend({kWidth, kHeight});
  return {area, 1.0};
}

double time_step(double end_s) {
  for (const double step : {10.0, 30.0, 60.0, 120.0, 300.0}) {
    if (end_s / step <= 12.0) return step;
  }
  return 600.0;
}

}  // namespace

CoveragePlot::CoveragePlot(double end_s) : end_s_(std::max(end_s, 1.0)), picture_(empty_picture()) {
  draw_axes();
}

types::Vector2 CoveragePlot::place(double t_s, double share) const {
  return {kMargin + (kWidth - 2 * kMargin) * t_s / end_s_, kMargin + (kHeight - 2 * kMargin) * share};
}

void CoveragePlot::draw_axes() {
  for (const double share : {0.0, 0.5, 0.9, 0.95, 0.99, 1.0}) {
    picture_.line(place(0.0, share), place(end_s_, share), kLine);
    if (share != 0.95 && share != 0.99)
      write_text(picture_, 8.0, place(0.0, share).y() + 5.0, std::to_string(static_cast<int>(100 * share)),
                 kInk);
  }
  for (double t_s = 0.0; t_s <= end_s_; t_s += time_step(end_s_)) {
    picture_.line(place(t_s, 0.0), place(t_s, 1.0), kLine);
    write_text(picture_, place(t_s, 0.0).x() - 8.0, kMargin - 10.0, std::to_string(static_cast<int>(t_s)),
               kInk);
  }
}

void CoveragePlot::curve(std::span<const std::pair<double, double>> coverage, sim::Colour colour) {
  types::Vector2 before = place(0.0, 0.0);
  for (const auto& [t_s, share] : coverage) {
    const types::Vector2 p = place(t_s, share);
    for (const double dy : {0.0, 1.0})
      picture_.line({before.x(), before.y() + dy}, {p.x(), p.y() + dy}, colour);
    before = p;
  }
}

void CoveragePlot::legend(std::string_view text, sim::Colour colour) {
  const double x = kWidth - kMargin - kLegendWidth, y = kMargin + 160.0 - kLegendLine * legends_++;
  for (const double dy : {-1.0, 0.0, 1.0}) picture_.line({x, y + dy}, {x + 22.0, y + dy}, colour);
  write_text(picture_, x + 30.0, y + 5.0, text, kInk);
}

}  // namespace topo::bench

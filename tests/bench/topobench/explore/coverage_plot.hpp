// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>
#include <utility>

#include "core/types/geometry.hpp"
#include "tests/sim/picture.hpp"

namespace topo::bench {

/// Share of the area over time, with lines at 50, 90, 95 and 99 % and at round times, labelled.
class CoveragePlot {
 public:
  /// From 0 to `end_s`.
  explicit CoveragePlot(double end_s);

  /// Seconds and share, in order of time.
  void curve(std::span<const std::pair<double, double>> coverage, sim::Colour colour);
  /// One more line of what the colours mean.
  void legend(std::string_view text, sim::Colour colour);

  [[nodiscard]] const sim::Picture& picture() const { return picture_; }

 private:
  [[nodiscard]] types::Vector2 place(double t_s, double share) const;
  void draw_axes();

  double end_s_;
  sim::Picture picture_;
  int legends_ = 0;
};

}  // namespace topo::bench

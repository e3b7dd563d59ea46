// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "core/types/transform.hpp"

namespace topo::calibration {

/// A piece of a figure: a speed, and for how long.
struct Leg {
  types::Twist2 twist;
  double seconds = 0.0;
};

/// An eight, turns on the spot to both sides, and a straight there and back, in a circle of about three
/// metres. Turns begin and end often, to both sides, which shows the delay and the scanner's place; straights
/// show wheels and yaw.
inline constexpr std::array<Leg, 8> kFigure{{{{0.35, 0.7}, 9.0},
                                             {{0.35, -0.7}, 9.0},
                                             {{0.0, 0.8}, 6.0},
                                             {{0.0, -0.8}, 6.0},
                                             {{0.35, 0.0}, 3.0},
                                             {{0.0, 0.8}, 3.9},
                                             {{0.35, 0.0}, 3.0},
                                             {{0.0, -0.8}, 3.9}}};
inline constexpr int kFigureRounds = 4;  ///< three minutes, 34 m

/// What to drive `seconds` after the beginning; nothing when the figure has ended.
[[nodiscard]] constexpr std::optional<types::Twist2> figure_twist(double seconds) {
  for (int round = 0; round < kFigureRounds; ++round) {
    for (const Leg& leg : kFigure) {
      if (seconds < leg.seconds) return leg.twist;
      seconds -= leg.seconds;
    }
  }
  return std::nullopt;
}

}  // namespace topo::calibration

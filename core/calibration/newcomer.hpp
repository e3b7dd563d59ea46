// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "core/calibration/still_picture.hpp"

namespace topo::calibration {

/// What counts as somebody who stands near the robot.
struct NewcomerParams {
  double nearer_m = 0.25;  ///< than before, for a beam to count: eight standard deviations of a range
  double range_min_m = 0.3;
  double range_max_m = 2.2;   ///< about 1 m away, up to the head over an upright scanner
  double width_min_m = 0.06;  ///< of what is seen in all: half a leg
  double together_m = 0.6;    ///< pieces this near are one: two legs, an arm
  std::size_t gap_beams = 4;  ///< within a piece
};

/// Something that is there and was not there before, in the scanner's own frame.
struct Newcomer {
  double angle_rad = 0.0;  ///< of its middle
  types::Vector2 middle_m{0.0, 0.0};
  double axis_rad = 0.0;  ///< in which it is longest, one way or the other
  std::array<types::Vector2, 2> ends_m{types::Vector2{0.0, 0.0}, types::Vector2{0.0, 0.0}};  ///< along it
  double range_m = 0.0;  ///< to its nearest point
  double width_m = 0.0;  ///< of all that is seen of it
};

/// All newcomers near the scanner, the widest first. Nothing for pictures with different beams.
[[nodiscard]] std::vector<Newcomer> newcomers(const StillPicture& before, const StillPicture& now,
                                              const NewcomerParams& params = {});

}  // namespace topo::calibration

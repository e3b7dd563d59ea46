// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>

#include "core/types/stamp.hpp"

namespace topo::travel {

struct RouteMapParams {
  double live_noise_m = 0.05;  ///< of a point of the newest scan: the scanner's and the pose's error
  double live_range_m = 3.0;   ///< what is farther is scanned again before it matters
  double mate_m = 1.2;         ///< around a team-mate, where a route is dear
  double near_m = 6.0;         ///< longer routes are found on the coarse map
  int coarse_doublings = 2;    ///< cells of the coarse map: four times as wide
  double aim_search_m = 2.0;   ///< around the robot, searched before a cell near a point is looked for
  double aim_beside_m = 0.5;   ///< between a point and the cell that stands for it
  double tight_ahead_m = 1.2;  ///< of a route: a passage that the robot stands before and does not enter
};

struct ObstacleMemoryParams {
  double same_echo_m = 0.15;      ///< echoes this near to each other are one; sonar resolves no more
  int echo_times = 3;             ///< an echo heard less often may be a reflection
  std::size_t echoes_max = 1000;  ///< kept at most
  /// What no laser sees is glass more often than a person.
  types::Duration echo_for = std::chrono::minutes(10), blocked_for = std::chrono::minutes(5);
  types::Duration forget_again = std::chrono::seconds(60);
  double blocked_radius_m = 0.25;  ///< of what the robot got stuck on, which no sensor outlines
};

}  // namespace topo::travel

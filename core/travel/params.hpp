// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>

#include "core/types/stamp.hpp"

namespace topo::travel {

struct RouteMapParams {
  double live_noise_m = 0.05;  ///< error of a point of the newest scan, from scanner and pose
  double live_range_m = 3.0;   ///< more distant points are scanned again before they matter
  double mate_m = 1.2;         ///< radius around a team-mate in which a route costs more
  double near_m = 6.0;         ///< longer routes are found on the coarse map
  int coarse_doublings = 2;    ///< cells of the coarse map: four times as wide
  double aim_search_m = 2.0;   ///< search around the robot before reachable_cell() looks for a cell
  double aim_beside_m = 0.5;   ///< distance between a point and the cell that replaces it
  double tight_ahead_m = 1.2;  ///< length of route tested for a passage that the robot does not enter
};

struct ObstacleMemoryParams {
  double same_echo_m = 0.15;      ///< echoes within this distance are one; the resolution of the sonar
  int echo_times = 3;             ///< an echo noted less often may be a reflection
  std::size_t echoes_max = 1000;  ///< limit of the stored echoes
  /// An obstacle that no laser detects is glass more often than a person.
  types::Duration echo_for = std::chrono::minutes(10), blocked_for = std::chrono::minutes(5);
  types::Duration forget_again = std::chrono::seconds(60);
  double blocked_radius_m = 0.25;  ///< of an obstacle at which the robot got stuck, which no sensor outlines
};

}  // namespace topo::travel

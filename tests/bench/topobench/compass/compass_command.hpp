// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/types/result.hpp"

namespace topo::bench {

struct CompassCommand {
  std::vector<std::filesystem::path> maps;
  std::vector<double> turns_deg = {7.0, 23.0, 47.0, 61.0, 89.0};
  bool beside = false;  ///< each map beside itself turned, as two wings of one building
  bool json = false;
};

/// How far the direction of a turned map is from that of the map, turned as much: 0 to 45 degrees, modulo 90.
/// Angles in radians; without a direction on either side nothing is known of it and it counts as 45.
double turn_error_deg(std::optional<double> angle_rad, std::optional<double> turned_rad, double turn_deg);

/// The error of the direction nearest to one that is right: of those that were found of a building.
double nearest_error_deg(const std::vector<double>& found_rad, double right_rad);

/// `topobench compass`: finds the direction of every map, turns the map, and finds it again (the whole
/// analysis each time, as `topobench analyse` does it); with `beside`, the directions of both in one map.
/// Prints the errors: each, the worst and the mean. All maps are named before the first is analysed.
types::Status run_compass(const CompassCommand& command);

}  // namespace topo::bench

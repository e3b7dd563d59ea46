// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/compass/compass_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/types/se2.hpp"
#include "tests/bench/topobench/analyse/map_input.hpp"
#include "tests/bench/topobench/analyse/timed_analysis.hpp"
#include "tests/bench/topobench/compass/turned_map.hpp"
#include "tests/bench/topobench/table/table_world.hpp"

namespace topo::bench {
namespace {

using nlohmann::json;

json degrees_of(std::optional<double> angle_rad) {
  if (!angle_rad) return nullptr;
  return *angle_rad / types::kDegree_rad;
}

std::optional<double> direction_of(const grid::DenseMap& map) {
  return timed_analysis(map, 1).analysis.compass.angle_rad;
}

/// Of the compass and of the wings.
std::vector<double> directions_of(const grid::DenseMap& map) {
  const analysis::Analysis analysis = timed_analysis(map, 1).analysis;
  std::vector<double> all_rad = analysis.wings_rad;
  if (analysis.compass.angle_rad) all_rad.push_back(*analysis.compass.angle_rad);
  return all_rad;
}

json in_degrees(std::vector<double> directions) {
  for (double& direction : directions) direction /= types::kDegree_rad;
  return directions;
}

struct Turned {
  json report;
  double error_deg = 0.0;
};

Turned alone(const grid::DenseMap& map, std::optional<double> angle_rad, double turn_deg) {
  const auto turned_rad = direction_of(turned_map(map, turn_deg * types::kDegree_rad));
  const double error_deg = turn_error_deg(angle_rad, turned_rad, turn_deg);
  return {{{"turn_deg", turn_deg}, {"compass_deg", degrees_of(turned_rad)}, {"error_deg", error_deg}},
          error_deg};
}

Turned beside(const grid::DenseMap& map, std::optional<double> angle_rad, double turn_deg) {
  const double turn_rad = turn_deg * types::kDegree_rad;
  const std::vector<double> found_rad = directions_of(side_by_side(map, turned_map(map, turn_rad)));
  const double error_deg = angle_rad ? std::max(nearest_error_deg(found_rad, *angle_rad),
                                                nearest_error_deg(found_rad, *angle_rad + turn_rad))
                                     : nearest_error_deg({}, 0.0);
  return {{{"turn_deg", turn_deg}, {"directions_deg", in_degrees(found_rad)}, {"error_deg", error_deg}},
          error_deg};
}

}  // namespace

double nearest_error_deg(const std::vector<double>& found_rad, double right_rad) {
  double nearest_deg = turn_error_deg(std::nullopt, std::nullopt, 0.0);
  for (const double one_rad : found_rad)
    nearest_deg = std::min(nearest_deg, turn_error_deg(right_rad, one_rad, 0.0));
  return nearest_deg;
}

double turn_error_deg(std::optional<double> angle_rad, std::optional<double> turned_rad, double turn_deg) {
  constexpr double kQuarter_deg = 90.0;
  if (!angle_rad || !turned_rad) return 0.5 * kQuarter_deg;
  return std::abs(std::remainder((*turned_rad - *angle_rad) / types::kDegree_rad - turn_deg, kQuarter_deg));
}

types::Status run_compass(const CompassCommand& command) {
  const auto files = world_files(command.maps);
  if (!files) return tl::unexpected(files.error());
  json each = json::array();
  double worst_deg = 0.0, sum_deg = 0.0;
  std::size_t count = 0;
  for (const std::filesystem::path& file : *files) {
    const auto input = read_map_input(file.string(), 0.0);
    if (!input) return tl::unexpected(input.error());
    print_warnings(file.string(), input->warnings);
    const std::optional<double> angle_rad = direction_of(input->map);
    json turns = json::array();
    for (const double turn_deg : command.turns_deg) {
      Turned turned =
          command.beside ? beside(input->map, angle_rad, turn_deg) : alone(input->map, angle_rad, turn_deg);
      turns.push_back(std::move(turned.report));
      worst_deg = std::max(worst_deg, turned.error_deg);
      sum_deg += turned.error_deg;
      ++count;
    }
    each.push_back(
        {{"map", file.stem()}, {"compass_deg", degrees_of(angle_rad)}, {"turns", std::move(turns)}});
  }
  const json printed{{"turned_maps", count},
                     {"error_deg_mean", count == 0 ? 0.0 : sum_deg / static_cast<double>(count)},
                     {"error_deg_max", worst_deg},
                     {"each", std::move(each)}};
  fmt::print("{}\n", command.json ? printed.dump() : printed.dump(2));
  return {};
}

}  // namespace topo::bench

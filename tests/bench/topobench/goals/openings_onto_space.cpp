// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/goals/openings_onto_space.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/goals/filters.hpp"
#include "core/goals/frontiers.hpp"

namespace topo::bench {
namespace {

using goals::Frontier;
using goals::Goal;
using types::Vector2;

constexpr double kBehind_m = 0.6;  // so near behind the frontier the robot's middle can be
constexpr double kNear_m = 3.0;    // a goal so near to where the robot would stand, and in sight, is as good

/// Connected unexplored space, cell by cell of the building.
class UnexploredSpace {
 public:
  UnexploredSpace(const grid::DenseMap& map, const DrivableTruth& truth, const types::Se2& T_building_map)
      : truth_(truth), number_(truth.swept.cells.size(), 0) {
    const types::Se2 T_map_building = T_building_map.inverse();
    const sim::Raster& swept = truth.swept;
    std::vector<std::uint8_t> open(swept.cells.size(), 0);
    for (int y = 0; y < swept.height; ++y) {
      for (int x = 0; x < swept.width; ++x) {
        const Vector2 p = T_map_building * swept.center(x, y);
        open[swept.index(x, y)] =
            swept.at(x, y) != 0 && map.state(map.cell_at(p)) == grid::CellState::kUnknown ? 1 : 0;
      }
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open[i] != 0 && number_[i] == 0) fill(i, open);
    }
  }

  /// The largest space that the robot's middle can be in within kBehind_m of a point of the building.
  [[nodiscard]] double behind_m2(const Vector2& p) const {
    const sim::Raster& poses = truth_.poses;
    const int reach = static_cast<int>(std::lround(kBehind_m / poses.resolution_m));
    const int column = poses.column(p.x()), row = poses.row(p.y());
    double largest = 0.0;
    for (int y = row - reach; y <= row + reach; ++y) {
      for (int x = column - reach; x <= column + reach; ++x) {
        if (poses.at(x, y) == 0 || (poses.center(x, y) - p).norm() > kBehind_m) continue;
        const std::uint32_t number = number_[poses.index(x, y)];
        if (number != 0) largest = std::max(largest, area_m2_[number - 1]);
      }
    }
    return largest;
  }

 private:
  void fill(std::size_t first, const std::vector<std::uint8_t>& open) {
    const auto width = static_cast<std::size_t>(truth_.swept.width);
    const auto number = static_cast<std::uint32_t>(area_m2_.size() + 1);
    std::vector<std::size_t> queue{first};
    number_[first] = number;
    const auto visit = [&](std::size_t i) {
      if (open[i] == 0 || number_[i] != 0) return;
      number_[i] = number;
      queue.push_back(i);
    };
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const std::size_t i = queue[next], x = i % width;
      if (x > 0) visit(i - 1);
      if (x + 1 < width) visit(i + 1);
      if (i >= width) visit(i - width);
      if (i + width < open.size()) visit(i + width);
    }
    const double cell_m = truth_.swept.resolution_m;
    area_m2_.push_back(static_cast<double>(queue.size()) * cell_m * cell_m);
  }

  const DrivableTruth& truth_;
  std::vector<std::uint32_t> number_;  ///< of the space a cell is in, from 1
  std::vector<double> area_m2_;
};

/// Where a robot would stand for a frontier: the nearest cell with room for it, through free space.
std::optional<grid::CellIndex> stand_for(const grid::DenseMap& map, const std::vector<float>& clearance_m,
                                         const Frontier& frontier) {
  std::vector<std::uint8_t> seen(map.cells.size(), 0);
  std::vector<std::uint32_t> queue = frontier.cells;
  for (const std::uint32_t i : queue) seen[i] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const grid::CellIndex c = map.cell(queue[next]);
    if (static_cast<double>(clearance_m[queue[next]]) >= goals::GoalParams{}.robot_radius_m) return c;
    for (const grid::CellIndex by : {grid::CellIndex{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      const grid::CellIndex to{c.x + by.x, c.y + by.y};
      if (map.state(to) != grid::CellState::kFree || seen[map.index(to)] != 0) continue;
      seen[map.index(to)] = 1;
      queue.push_back(static_cast<std::uint32_t>(map.index(to)));
    }
  }
  return std::nullopt;
}

bool serves(const grid::DenseMap& map, const Goal& goal, const Frontier& frontier,
            const std::optional<grid::CellIndex>& stand) {
  const grid::CellIndex opening = map.cell_at(goal.opening);
  if (map.contains(opening) && std::binary_search(frontier.cells.begin(), frontier.cells.end(),
                                                  static_cast<std::uint32_t>(map.index(opening))))
    return true;
  return stand && (map.centre_of(*stand) - goal.p_map).norm() <= kNear_m &&
         goals::sees(map, *stand, map.cell_at(goal.p_map));
}

std::string fate_of_nearest(std::span<const Goal> rejected, const Vector2& p_map) {
  const auto away = [&](const Goal& g) { return (g.opening - p_map).norm(); };
  const auto nearest = std::min_element(rejected.begin(), rejected.end(),
                                        [&](const Goal& a, const Goal& b) { return away(a) < away(b); });
  if (nearest == rejected.end() || away(*nearest) > kNear_m) return "no candidate near";
  return std::string(goals::to_text(nearest->verdict));
}

}  // namespace

DrivableTruth drivable_truth(sim::Raster poses, double radius_m) {
  DrivableTruth truth{poses, std::move(poses)};
  const int reach = static_cast<int>(std::lround(radius_m / truth.poses.resolution_m));
  for (int y = 0; y < truth.poses.height; ++y) {
    for (int x = 0; x < truth.poses.width; ++x) {
      if (truth.poses.at(x, y) == 0) continue;
      const bool inner = truth.poses.at(x - 1, y) != 0 && truth.poses.at(x + 1, y) != 0 &&
                         truth.poses.at(x, y - 1) != 0 && truth.poses.at(x, y + 1) != 0;
      if (inner) continue;
      for (int v = -reach; v <= reach; ++v) {
        for (int u = -reach; u <= reach; ++u) {
          if (u * u + v * v <= reach * reach) truth.swept.set(x + u, y + v, 1);
        }
      }
    }
  }
  return truth;
}

OpeningsOntoSpace openings_onto_space(const analysis::Analysis& analysis, const DrivableTruth& truth,
                                      const types::Se2& T_building_map, double space_min_m2) {
  const grid::DenseMap& map = analysis.map;
  const std::vector<float> clearance_m = analysis::clearance_of(analysis);
  const UnexploredSpace space(map, truth, T_building_map);
  OpeningsOntoSpace out;
  std::vector<bool> is_there_for_one(analysis.goals.goals.size(), false);
  for (const Frontier& frontier : goals::find_frontiers(map)) {
    OpeningOntoSpace opening;
    for (const std::uint32_t i : frontier.cells)
      opening.space_m2 =
          std::max(opening.space_m2, space.behind_m2(T_building_map * map.centre_of(map.cell(i))));
    if (opening.space_m2 < space_min_m2) continue;
    opening.p_map = map.centre_of(map.cell(goals::middle_of(map, frontier.cells)));
    opening.width_m = frontier.width_m;
    const std::optional<grid::CellIndex> stand = stand_for(map, clearance_m, frontier);
    for (std::size_t k = 0; k < analysis.goals.goals.size(); ++k) {
      if (!serves(map, analysis.goals.goals[k], frontier, stand)) continue;
      opening.has_goal = is_there_for_one[k] = true;
    }
    if (!opening.has_goal) opening.why = fate_of_nearest(analysis.goals.rejected, opening.p_map);
    out.openings.push_back(std::move(opening));
  }
  out.goals = static_cast<std::size_t>(std::count(is_there_for_one.begin(), is_there_for_one.end(), true));
  return out;
}

}  // namespace topo::bench

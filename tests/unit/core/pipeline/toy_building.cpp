// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/core/pipeline/toy_building.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>

#include "core/grid/occupancy_grid.hpp"

namespace topo::pipeline {

ToyBuilding::ToyBuilding(std::vector<std::string> rows, double range_m)
    : rows_(rows.rbegin(), rows.rend()), range_m_(range_m), snapshot_{0,
                                                                      0,
                                                                      {},
                                                                      {},
                                                                      {},
                                                                      grid::OccupancyGrid(tile_arena_, 0.05),
                                                                      walls::WallStore(column_arena_, 0.05),
                                                                      {}} {
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const std::size_t column = rows_[row].find('S');
    if (column == std::string::npos) continue;
    start_ = {(static_cast<double>(column) + 0.5) * kSide_m, (static_cast<double>(row) + 0.5) * kSide_m};
  }
  robot_ = start_;
  control_.base_ready = true;
  control_.battery_v = 12.6F;
  tracked_.matched = true;
  add_keyframe();
}

bool ToyBuilding::wall_at(const types::Vector2& p) const {
  const auto column = static_cast<std::ptrdiff_t>(std::floor(p.x() / kSide_m));
  const auto row = static_cast<std::ptrdiff_t>(std::floor(p.y() / kSide_m));
  if (row < 0 || column < 0 || row >= std::ssize(rows_)) return true;
  const std::string& text = rows_[static_cast<std::size_t>(row)];
  return column >= std::ssize(text) || text[static_cast<std::size_t>(column)] == '#';
}

void ToyBuilding::bend(double by_m) {
  for (types::KeyframePose& keyframe : snapshot_.keyframes) {
    const types::Se2 was = keyframe.T_map_base.se2();
    keyframe.T_map_base = {was.x_m + by_m, was.y_m, was.theta_rad};
  }
}

void ToyBuilding::close(int column, int row) {
  rows_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = '#';
}

void ToyBuilding::open(int column, int row) {
  rows_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = ' ';
}

void ToyBuilding::see(const types::Vector2& p, bool free) {
  const grid::CellIndex cell = snapshot_.grid.cell_at(p);
  const auto tile = [](std::int32_t v) { return v >> 5; };
  auto& counts = snapshot_.grid.tile_to_change(tile(cell.x), tile(cell.y))
                     .cells[grid::Tile::index(cell.x & 31, cell.y & 31)];
  counts = free ? grid::CellCounts{0, 5} : grid::CellCounts{5, 0};
}

void ToyBuilding::look_around() {
  constexpr int kRays = 1440;
  const grid::OccupancyGrid before = snapshot_.grid;
  for (int i = 0; i < kRays; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kRays;
    if (std::abs(types::wrap_angle(angle_rad - heading_rad_)) > half_field_rad_) continue;
    const types::Vector2 direction(std::cos(angle_rad), std::sin(angle_rad));
    for (double r_m = 0.0; r_m < range_m_; r_m += 0.025) {
      const types::Vector2 p = robot_ + r_m * direction;
      const bool wall = wall_at(p);
      see(p, !wall);
      if (wall) break;
    }
  }
  ++snapshot_.revision;
  snapshot_.changed_cells += grid::differing_cells(before, snapshot_.grid);
  snapshot_.stamp = now_;
}

void ToyBuilding::add_keyframe() {
  snapshot_.keyframes.push_back(
      {now_, types::Transform2<types::Map, types::Base>(robot_.x(), robot_.y(), heading_rad_)});
}

void ToyBuilding::follow(const Plan& plan, double step_m) {
  control_.mode = ControlMode::kStanding;
  control_.goal_id = plan.goal_id;
  if (!plan.moving) return;
  if (plan.turn_to_rad) {
    heading_rad_ = *plan.turn_to_rad;
    control_.mode = ControlMode::kArrived;
    return;
  }
  control_.mode = ControlMode::kFollowing;
  double left_m = step_m;
  for (std::size_t i = 1; i < plan.points && left_m > 0.0; ++i) {
    const types::Vector2 step = plan.path_odom[i] - robot_;
    const double length_m = std::min(step.norm(), left_m);
    if (length_m <= 1e-9) continue;
    robot_ += step.normalized() * length_m;
    heading_rad_ = std::atan2(step.y(), step.x());
    left_m -= length_m;
    path_m_ += length_m;
  }
  if (left_m > 1e-9 && plan.path_ends_at_goal) control_.mode = ControlMode::kArrived;
}

PlanningOutput ToyBuilding::run_period(PlanningState& state, const Mission& mission, double step_m) {
  if ((snapshot_.keyframes.back().T_map_base.se2().translation() - robot_).norm() > 0.4) add_keyframe();
  look_around();
  control_.stamp = now_;
  control_.odometry.stamp = now_;
  control_.odometry.T_odom_base = {robot_.x(), robot_.y(), heading_rad_};
  tracked_.stamp = now_;
  tracked_.revision = snapshot_.revision;
  PlanningInput input;
  input.now = now_;
  input.map = &snapshot_;
  input.tracked = &tracked_;
  input.control = &control_;
  if (team_ != nullptr) input.team = *team_;
  input.front = front_;
  input.area = area_;
  input.doubted = doubted_;
  input.mission = mission;
  PlanningOutput out = planning_step(state, input);
  follow(out.plan, step_m);
  now_ += std::chrono::milliseconds(500);
  return out;
}

double ToyBuilding::coverage() const {
  // The floor that hangs together with the start, by characters; each is known when its middle is.
  const auto width = std::ssize(rows_.front());
  std::set<std::ptrdiff_t> seen;
  std::queue<std::ptrdiff_t> open;
  const auto key = [&](std::ptrdiff_t column, std::ptrdiff_t row) { return row * width + column; };
  const auto middle = [&](std::ptrdiff_t k) {
    return types::Vector2((static_cast<double>(k % width) + 0.5) * kSide_m,
                          (static_cast<double>(k / width) + 0.5) * kSide_m);
  };
  open.push(key(static_cast<std::ptrdiff_t>(start_.x() / kSide_m),
                static_cast<std::ptrdiff_t>(start_.y() / kSide_m)));
  seen.insert(open.front());
  std::size_t known = 0;
  while (!open.empty()) {
    const std::ptrdiff_t k = open.front();
    open.pop();
    if (snapshot_.grid.state(snapshot_.grid.cell_at(middle(k))) == grid::CellState::kFree) ++known;
    for (const std::ptrdiff_t next : {k - 1, k + 1, k - width, k + width}) {
      if (!wall_at(middle(next)) && seen.insert(next).second) open.push(next);
    }
  }
  return static_cast<double>(known) / static_cast<double>(seen.size());
}

}  // namespace topo::pipeline

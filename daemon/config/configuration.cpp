// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/configuration.hpp"

#include <algorithm>
#include <cmath>

namespace topo::daemon {

slam::MapperParams mapper_params(const Configuration& configuration) {
  slam::MapperParams params = configuration.mapping;
  const ScannerConfig& front = configuration.front;
  const ScannerConfig& coronal = configuration.coronal;
  params.T_base_laser = {front.x_m, front.y_m, front.yaw_rad};
  // Status packets that are older than they look cover a scan later.
  params.odometry_wait_s += std::max(configuration.base.status_delay_s, 0.0);
  params.coronal.x_m = coronal.x_m;
  params.coronal.y_m = coronal.y_m;
  params.coronal.z_m = coronal.z_m;
  params.coronal.roll_rad = coronal.roll_rad;
  params.coronal.mirrored = coronal.mirrored;
  return params;
}

pipeline::PlannerParams planner_params(const Configuration& configuration) {
  const ExplorationConfig& e = configuration.exploration;
  const MotionConfig& m = configuration.motion;
  const types::Footprint hull = footprint(configuration);
  // On a route the robot must be able to turn on the spot, and to drive with the margin that the gate keeps.
  const double disc_m =
      std::max(types::reach_m(hull) + std::min(m.margin_m, types::RobotLimits{}.turn_margin_m),
               hull.half_width_m + m.margin_m);
  const grid::TravelRules usual;
  pipeline::PlannerParams params;
  params.explore.strategy = e.strategy;
  if (const auto finish = exploration::parse_finish(e.finish)) set_finish(*finish, params.explore);
  params.travel.radius_m = m.passage_radius_m > 0.0 ? m.passage_radius_m : disc_m;
  // Radius for driving straight through a door that is too narrow to turn in. In the map a door is up to a
  // cell narrower than in reality: a passage that appears half a centimetre too narrow is tried, and the
  // scanner decides.
  constexpr double kTried_m = 0.005;
  const double straight_m = hull.half_width_m + m.margin_m - kTried_m;
  params.travel.tight_m = m.passage_radius_m > 0.0 ? m.passage_radius_m : std::min(straight_m, disc_m);
  params.travel.preferred_m = params.travel.radius_m + usual.preferred_m - usual.radius_m;
  params.analysis.goals.robot_radius_m = params.travel.radius_m;
  params.area = configuration.area;
  params.T_base_laser = mapper_params(configuration).T_base_laser;
  params.explore.frontier_min_m = e.frontier_min_m;
  params.explore.pursuit.goal_reached_m = e.goal_reached_m;
  params.explore.homing.home_reached_m = e.home_reached_m;
  params.explore.homing.brakes_mps2 = configuration.base.deceleration_mps2;
  params.explore.pursuit.give_up_s = e.goal_give_up_s;
  params.battery.home_v = e.battery_home_v;
  params.battery.charge_home = e.charge_home;
  return params;
}

pipeline::ControlSetup control_setup(const Configuration& configuration) {
  const BaseConfig& base = configuration.base;
  pipeline::ControlSetup setup;
  setup.limits.take_limits(base);
  setup.limits.footprint = footprint(configuration);
  setup.limits.margin_m = configuration.motion.margin_m;
  setup.T_base_laser = mapper_params(configuration).T_base_laser;
  setup.area = configuration.area;
  setup.model = model_size(configuration.robot.model);
  return setup;
}

pipeline::ControlParams control_params(const Configuration& configuration) {
  pipeline::ControlParams params;
  params.plausibility = configuration.plausibility;
  params.perception.stop_zone.masks = configuration.front.masks;
  return params;
}

bool is_upside_down(const ScannerConfig& front) { return front.mirrored != (std::cos(front.roll_rad) < 0.0); }

types::Footprint footprint(const Configuration& configuration) {
  const types::ModelSize model = model_size(configuration.robot.model);
  const RobotConfig& robot = configuration.robot;
  const auto or_model = [](double own, double models) { return own > 0.0 ? own : models; };
  types::Footprint footprint{or_model(robot.length_front_m, model.front_m),
                             or_model(robot.length_rear_m, model.rear_m),
                             or_model(robot.width_m, model.width_m) / 2.0};
  // A configured hull may extend beyond the model's circle.
  const bool is_models = robot.length_front_m <= 0.0 && robot.length_rear_m <= 0.0 && robot.width_m <= 0.0;
  if (is_models) footprint.swing_radius_m = model.swing_radius_m;
  return footprint;
}

types::ModelSize model_size(RobotModel model) {
  return model == RobotModel::kP3at ? types::kP3at : types::kP3dx;
}

const char* model_name(RobotModel model) { return model == RobotModel::kP3at ? "P3-AT" : "P3-DX"; }

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// The mapper on the simulated sensors at the stated difficulty, in lock-step: a fixed course through a drawn
// building, against the truth that the mapper never sees.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "core/pipeline/mapping_step.hpp"
#include "core/walls/height_column.hpp"
#include "tests/sim/picture.hpp"
#include "tests/sim/value_feed.hpp"

namespace topo {
namespace {

using sim::Se2;
using sim::SimTime;

constexpr double kLaserAhead_m = 0.10;

sim::RobotSetup robot_with_two_lasers(const Se2& start) {
  sim::RobotSetup setup;
  setup.start = start;
  sim::LaserSetup front, coronal;
  front.mount.x_m = kLaserAhead_m;
  front.mount.z_m = 0.30;
  coronal.mount.z_m = 0.45;
  coronal.mount.plane = sim::ScanPlane::kCoronal;
  setup.lasers = {front, coronal};
  return setup;
}

slam::MapperParams mapper_params() {
  slam::MapperParams params;
  params.T_base_laser = {kLaserAhead_m, 0.0, 0.0};
  params.coronal.z_m = 0.45;
  return params;
}

struct Course {
  std::vector<Se2> truth;                         ///< in the building
  std::vector<Se2> live;                          ///< in map, as it was told at once
  std::vector<Se2> estimate;                      ///< in map, corrected by what came later
  std::vector<std::pair<std::size_t, Se2>> hung;  ///< node and place relative to it
  std::vector<double> step_ms;                    ///< of steps that placed a scan
  int lost = 0;
  int closures = 0;
};

/// Drives the way points once and maps; truth and estimate are taken at the same stamps.
Course drive(sim::Simulation& simulation, const sim::RobotSetup& setup, std::vector<sim::Vector2> points,
             int laps, pipeline::MappingState& state) {
  sim::ValueFeed feed(setup);
  sim::WayPointDrive wheels(std::move(points), laps);
  sim::RobotSetup with = setup;
  with.drive = &wheels;
  with.sink = &feed;
  const auto robot = simulation.add_robot(with);
  if (!robot) {
    ADD_FAILURE() << robot.error().message;
    return {};
  }
  Course course;
  const auto step = [&](const pipeline::MappingInput& input) {
    const auto begin = std::chrono::steady_clock::now();
    const pipeline::MappingOutput output = mapping_step(state, input);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    if (!output.matches.empty())
      course.step_ms.push_back(took.count() / static_cast<double>(output.matches.size()));
    for (const slam::MatchReport& match : output.matches) {
      course.truth.push_back(simulation.body(*robot).pose_at(match.stamp.time_since_epoch()));
      course.live.push_back(match.T_map_base);
      course.hung.emplace_back(match.node, match.T_node_base);
      course.lost += match.matched ? 0 : 1;
    }
    for (const slam::LoopVerdict& verdict : output.loop_verdicts) course.closures += verdict.accepted;
    for (const slam::LoopQuery& query : output.loop_queries) state.offer(slam::find_closures(query));
    if (output.graph_query) state.offer(slam::solve_graph(*output.graph_query));
  };
  types::Scan scan;
  while (!wheels.finished() && simulation.now() < std::chrono::minutes(15)) {
    simulation.advance_to(simulation.now() + std::chrono::milliseconds(5));
    feed.sample(simulation.body(*robot));
    while (const auto sample = feed.next_odometry()) step({{&*sample, 1}, nullptr, nullptr});
    while (feed.next_scan(1, scan)) step({{}, nullptr, &scan});
    while (feed.next_scan(0, scan)) step({{}, &scan, nullptr});
  }
  EXPECT_TRUE(wheels.finished());
  (void)state.finish();
  for (const auto& [node, T_node_base] : course.hung) {
    course.estimate.push_back(state.mapper().poses()[node] * T_node_base);
  }
  course.truth.resize(course.estimate.size());
  return course;
}

/// Root mean square distance with the map laid on the building by the first pose alone: what a user sees who
/// knows where the robot began.
double rmse_m(const Course& course, const std::vector<Se2>& estimate, double& worst) {
  const Se2 T_building_map = course.truth.front() * estimate.front().inverse();
  double sum = 0.0;
  worst = 0.0;
  for (std::size_t i = 0; i < course.truth.size(); ++i) {
    const double d = ((T_building_map * estimate[i]).translation() - course.truth[i].translation()).norm();
    sum += d * d;
    worst = std::max(worst, d);
  }
  return std::sqrt(sum / static_cast<double>(course.truth.size()));
}

/// Share of the map's occupied cells that lie within `tolerance` of a surface of the building.
double share_on_surfaces(const pipeline::MapSnapshot& map, const sim::World& world, const Se2& T_building_map,
                         double tolerance_m) {
  std::size_t on = 0, all = 0;
  map.grid.for_each_known([&](grid::CellIndex cell, grid::CellState state) {
    if (state != grid::CellState::kOccupied) return;
    const sim::Vector2 p = T_building_map * map.grid.centre_of(cell);
    ++all;
    constexpr double kHeight_m = 0.30;
    double nearest = HUGE_VAL;
    for (int k = 0; k < 16; ++k)
      nearest = std::min(nearest, world.level_range_m(p.x(), p.y(), kHeight_m, 0.3927 * k));
    if (nearest < tolerance_m || world.solid_at(p.x(), p.y(), kHeight_m)) ++on;
  });
  return static_cast<double>(on) / static_cast<double>(std::max<std::size_t>(1, all));
}

void save_picture(const sim::World& world, const Course& course, const pipeline::MapSnapshot& map,
                  const char* name) {
  const char* folder = std::getenv("TOPOMETRIC_OUT");
  if (folder == nullptr) return;
  std::filesystem::create_directories(folder);
  sim::Picture picture(world.extents(), 0.02);
  picture.world(world);
  const Se2 T_building_map = course.truth.front() * course.estimate.front().inverse();
  map.grid.for_each_known([&](grid::CellIndex cell, grid::CellState state) {
    if (state == grid::CellState::kOccupied)
      picture.dot(T_building_map * map.grid.centre_of(cell), sim::kScanInk);
  });
  picture.path(course.truth, sim::kTruthInk);
  std::vector<Se2> estimate;
  for (const Se2& pose : course.estimate) estimate.push_back(T_building_map * pose);
  picture.path(estimate, sim::kEstimateInk);
  ASSERT_TRUE(picture.save_png(std::filesystem::path(folder) / name).has_value());
}

void print(const char* name, const Course& course) {
  double worst = 0.0, worst_live = 0.0;
  const double rmse = rmse_m(course, course.estimate, worst), live = rmse_m(course, course.live, worst_live);
  std::vector<double> ms = course.step_ms;
  std::sort(ms.begin(), ms.end());
  double sum = 0.0;
  for (const double v : ms) sum += v;
  std::printf(
      "%s: %zu scans, rmse %.3f m (worst %.3f m), before corrections %.3f m (%.3f m), lost %d, closures %d, "
      "step mean %.2f p99 %.2f max %.1f ms\n",
      name, course.truth.size(), rmse, worst, live, worst_live, course.lost, course.closures,
      sum / static_cast<double>(ms.size()), ms[ms.size() * 99 / 100], ms.back());
}

class FixedCourse : public ::testing::TestWithParam<unsigned> {};

TEST_P(FixedCourse, IsMappedToCentimetresOfTheTruth) {
  auto world = sim::World::load(std::filesystem::path(TOPOMETRIC_SOURCE_DIR) / "config/worlds/course.toml");
  ASSERT_TRUE(world.has_value()) << world.error().message;
  const Se2 start = world->start_poses().front();
  sim::Simulation simulation(std::move(*world), {}, GetParam());
  pipeline::MappingState state(mapper_params());
  const std::vector<sim::Vector2> round{{10.0, 1.1}, {18.9, 1.1}, {18.9, 7.0}, {18.9, 13.9}, {10.0, 13.9},
                                        {1.1, 13.9}, {1.1, 7.0},  {1.1, 1.1},  {3.0, 1.1}};
  const Course course = drive(simulation, robot_with_two_lasers(start), round, 1, state);
  ASSERT_GT(course.truth.size(), 1000U);
  const auto map = state.make_snapshot();
  print("course", course);
  save_picture(simulation.world(), course, *map, "course.png");
  double worst = 0.0;
  EXPECT_LT(rmse_m(course, course.estimate, worst), 0.10);
  EXPECT_EQ(course.lost, 0);
  EXPECT_GT(share_on_surfaces(*map, simulation.world(),
                              course.truth.front() * course.estimate.front().inverse(), 0.15),
            0.95);
  std::size_t walls = 0, columns = 0;
  map->walls.columns().for_each([&](patricia::Key, walls::Slabs slabs) {
    ++columns;
    walls += walls::is_wall(slabs) ? 1U : 0U;
  });
  EXPECT_GT(columns, 1000U);
  EXPECT_GT(walls, 200U) << "the coronal laser saw walls from floor to ceiling";
  EXPECT_LT(walls, columns);
}

INSTANTIATE_TEST_SUITE_P(Seeds, FixedCourse, ::testing::Values(1U, 2U));

}  // namespace
}  // namespace topo

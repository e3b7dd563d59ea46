// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The base thread's step in lock-step with the simulated robot, faults and all: nothing is touched that could
// be avoided (issue "Map to home", base thread and safety).
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "tests/integration/drive_rig.hpp"
#include "tests/unit/sim/rooms.hpp"

namespace topo::test {
namespace {

using pipeline::ControlMode;
using sim::Vector2;

sim::World office() {
  auto world = sim::World::load(std::filesystem::path(TOPOMETRIC_SOURCE_DIR) / "config/worlds/office.toml");
  if (!world.has_value()) std::abort();
  return std::move(*world);
}

struct Leg {
  double seconds = 0.0, metres = 0.0, slowest_mps = 1e9;
  bool arrived = false;
};

Leg drive(DriveRig& rig, const std::vector<Vector2>& route, double limit_s) {
  Leg leg;
  const double begin_s = rig.now_s(), begin_m = rig.body().path_m();
  rig.go(route);
  leg.arrived = rig.run(limit_s, [&] {
    if (std::getenv("TOPO_TRACE") != nullptr && static_cast<long>(rig.now_s() * 20.0 + 0.5) % 4 == 0) {
      const auto p = rig.body().truth();
      const auto& r = rig.report();
      std::printf("%6.2f (%.2f %.2f %.2f) v %.2f cmd %.2f %.2f free %.2f %s %s\n", rig.now_s(), p.x_m, p.y_m,
                  p.theta_rad, rig.v_mps(), r.commanded.v_mps, r.commanded.omega_radps, r.free_distance_m,
                  std::string(to_text(r.mode)).c_str(), std::string(to_text(r.reason)).c_str());
    }
    return rig.report().mode == ControlMode::kArrived || rig.report().mode == ControlMode::kStuck;
  }) && rig.report().mode == ControlMode::kArrived;
  leg.seconds = rig.now_s() - begin_s;
  leg.metres = rig.body().path_m() - begin_m;
  return leg;
}

TEST(SafetyInTheOffice, DrivesThroughDoorsAndClutteredCorridors) {
  sim::World world = office();
  const std::vector<Vector2> stops{{1.0, 7.0},   {12.0, 7.0},  {13.0, 4.0},  {12.0, 7.0},
                                   {25.0, 9.0},  {33.0, 13.0}, {25.0, 16.0}, {18.0, 19.0},
                                   {14.0, 16.0}, {13.0, 24.0}, {1.0, 18.0},  {1.0, 7.0}};
  std::vector<std::vector<Vector2>> ways;
  for (std::size_t i = 1; i < stops.size(); ++i) ways.push_back(way_in(world, stops[i - 1], stops[i]));
  DriveSetup setup;
  setup.start = {1.0, 7.0, 0.0};
  if (const char* seed = std::getenv("TOPO_SEED"); seed != nullptr) setup.seed = std::stoul(seed);
  DriveRig rig(std::move(world), setup);
  for (const auto& way : ways) {
    ASSERT_FALSE(way.empty());
    const Leg leg = drive(rig, way, 200.0);
    std::printf("to (%.1f, %.1f): %5.1f m in %5.1f s, %.2f m/s, %s, recoveries %u, collisions %lu\n",
                way.back().x(), way.back().y(), leg.metres, leg.seconds, leg.metres / leg.seconds,
                leg.arrived ? "arrived" : std::string(to_text(rig.report().mode)).c_str(),
                rig.report().recoveries, rig.body().collisions());
    EXPECT_TRUE(leg.arrived);
  }
  EXPECT_EQ(rig.body().collisions(), 0U);
}

}  // namespace
}  // namespace topo::test

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/calibrate/standing.hpp"

#include <cstdlib>

#include "tests/bench/topobench/calibrate/hand_drive.hpp"
#include "tests/sim/shapes.hpp"
#include "tests/sim/value_feed.hpp"

namespace topo::bench {

calibration::StillPicture Standing::seen(const sim::LaserMount& mount,
                                         const std::vector<sim::Vector2>& people) const {
  auto world = sim::World::from_scene_text(furnished_room(), "room.toml");
  if (!world) std::abort();  // the room is written down in this program
  constexpr double kRadius_m = 0.2, kHeight_m = 1.75;
  for (const sim::Vector2& at : people)
    world->add_movable(sim::make_cylinder(pose * at, kRadius_m, 0.0, kHeight_m));
  sim::RobotSetup setup;
  setup.lasers.resize(1);
  sim::LaserSimulator laser(*world, setup.lasers[0].model, mount, sim::Difficulty{}, seed);
  sim::ValueFeed feed(setup);
  calibration::PictureTaker taker;
  types::Scan scan;
  constexpr std::uint64_t kScans = 10;
  for (std::uint64_t i = 0; i < kScans; ++i) {
    feed.on_sweep(0, laser.measure(sim::SimTime{0}, i, [this](sim::SimTime) { return pose; }));
    if (feed.next_scan(0, scan)) taker.add(scan);
  }
  return taker.picture();
}

}  // namespace topo::bench

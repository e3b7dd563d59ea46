// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/simulation.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <string>

#include "tests/sim/area.hpp"
#include "tests/sim/picture.hpp"
#include "tests/sim/way_point_drive.hpp"
#include "tests/unit/sim/rooms.hpp"

namespace topo::sim {
namespace {

class Recorder final : public SensorSink {
 public:
  void on_sweep(std::size_t laser, const Sweep& sweep) override {
    ++sweeps;
    last_end = sweep.end;
    for (const std::uint32_t mm : sweep.range_mm) mix(mm + (laser << 20U));
    for (const std::uint16_t i : sweep.intensity) mix(i);
  }
  void on_sonar(const SonarEcho& echo) override {
    ++echoes;
    mix(static_cast<std::uint64_t>(std::llround(1e6 * echo.range_m)) +
        static_cast<std::uint64_t>(echo.index));
  }
  int sweeps = 0;
  int echoes = 0;
  SimTime last_end{0};
  std::uint64_t hash = 0;

 private:
  void mix(std::uint64_t value) { hash = derive_seed(hash, value); }
};

RobotSetup robot(WheelDrive* drive, SensorSink* sink) {
  RobotSetup setup;
  setup.start = {2.0, 3.0, 0.0};
  setup.lasers = {{LaserModel::utm_30lx(), {0.02, 0.0, 0.3, 0.0, ScanPlane::kLevel}, SimTime{0}},
                  {LaserModel::utm_30lx(), {0.1, 0.0, 0.4, 0.0, ScanPlane::kCoronal}, SimTime{7'000'000}}};
  setup.drive = drive;
  setup.sink = sink;
  return setup;
}

struct Outcome {
  std::uint64_t hash;
  Se2 truth;
  int sweeps, echoes;
  bool operator==(const Outcome&) const = default;
};

Outcome run(std::uint64_t seed, const std::vector<SimTime>& stops) {
  Recorder recorder;
  WayPointDrive drive({{6.0, 3.0}, {6.0, 4.5}, {2.0, 4.5}, {2.0, 3.0}}, 0);
  Simulation simulation(scene(room_text()), Difficulty{}, seed);
  EXPECT_TRUE(simulation.add_robot(robot(&drive, &recorder)).has_value());
  for (const SimTime stop : stops) simulation.advance_to(stop);
  return {recorder.hash, simulation.body(0).truth(), recorder.sweeps, recorder.echoes};
}

TEST(Simulation, SameSeedSameBytesHoweverTheTimeIsCut) {
  const SimTime end{6'000'000'000};
  const Outcome whole = run(9, {end});
  std::vector<SimTime> pieces;
  for (SimTime t{0}; t < end; t += SimTime{13'370'001}) pieces.push_back(t);
  pieces.push_back(end);
  EXPECT_EQ(whole, run(9, pieces));
  EXPECT_NE(whole.hash, run(10, {end}).hash);
}

TEST(Simulation, SensorsKeepTheirRates) {
  const Outcome outcome = run(1, {SimTime{2'000'000'000}});
  EXPECT_NEAR(outcome.sweeps, 2 * 2 * 40, 2);
  EXPECT_NEAR(outcome.echoes, 2 * 2 * 25, 2);
}

TEST(Simulation, ASweepIsHandedOverWhenItHasEnded) {
  Recorder recorder;
  Simulation simulation(scene(room_text()), Difficulty::none(), 1);
  ASSERT_TRUE(simulation.add_robot(robot(nullptr, &recorder)).has_value());
  simulation.advance_to(SimTime{18'000'000});
  EXPECT_EQ(recorder.sweeps, 0);
  simulation.advance_to(SimTime{19'000'000});
  EXPECT_EQ(recorder.sweeps, 1);
  EXPECT_EQ(recorder.last_end, SimTime{18'750'000});
}

TEST(Simulation, ABoxAppearsAheadAndStopsTheRobot) {
  WayPointDrive drive({{7.0, 3.0}}, 1);
  Simulation simulation(scene(room_text()), Difficulty::none(), 1);
  ASSERT_TRUE(simulation.add_robot(robot(&drive, nullptr)).has_value());
  const auto box = simulation.add_box_ahead(0, 1.0);
  ASSERT_TRUE(box.has_value());
  simulation.advance_to(SimTime{8'000'000'000});
  EXPECT_NEAR(simulation.body(0).truth().x_m, 3.0, 2e-3);
  EXPECT_EQ(simulation.body(0).collisions(), 1U);
  EXPECT_FALSE(simulation.add_box_ahead(0, -0.3).has_value());  // into the robot
  ASSERT_TRUE(simulation.remove_obstacle(*box).has_value());
  simulation.advance_to(SimTime{20'000'000'000});
  EXPECT_NEAR(simulation.body(0).truth().x_m, 7.0, 0.2);
}

TEST(Simulation, OnlyAnObstacleThatStandsThereIsRemoved) {
  Simulation simulation(scene(room_text()), Difficulty::none(), 1);
  ASSERT_TRUE(simulation.add_robot(robot(nullptr, nullptr)).has_value());
  const auto nothing = simulation.remove_obstacle(77);
  ASSERT_FALSE(nothing.has_value());
  EXPECT_NE(nothing.error().message.find("no obstacle"), std::string::npos);
  const auto box = simulation.add_box_ahead(0, 1.0);
  ASSERT_TRUE(box.has_value());
  const auto robots_own = simulation.remove_obstacle(*box - 1);
  ASSERT_FALSE(robots_own.has_value());
  EXPECT_NE(robots_own.error().message.find(fmt::format("expected one of {}", *box)), std::string::npos);
  EXPECT_TRUE(simulation.remove_obstacle(*box).has_value());
  EXPECT_FALSE(simulation.remove_obstacle(*box).has_value());  // it is gone already
}

TEST(Simulation, RobotsSeeEachOtherAndWalkersWait) {
  Recorder recorder;
  Simulation simulation(scene(room_text()), Difficulty::none(), 1);
  ASSERT_TRUE(simulation.add_robot(robot(nullptr, &recorder)).has_value());
  RobotSetup second = robot(nullptr, nullptr);
  EXPECT_FALSE(simulation.add_robot(second).has_value());  // two in one place
  second.start = {5.0, 3.0, 0.0};
  ASSERT_TRUE(simulation.add_robot(second).has_value());
  EXPECT_NEAR(simulation.world().level_range_m(2.5, 3.0, 0.3, 0.0), 2.5 - second.model.length_rear_m, 1e-6);
  simulation.add_walker({{{3.5, 1.0}, {3.5, 5.0}, {2.0, 3.0}}, 1.0, 0.25, 1.75});
  simulation.advance_to(SimTime{12'000'000'000});
  // Stands before robot 0, which is in the way, 5 cm from its swing circle.
  RayOptions own;
  own.exclude = simulation.body(0).movable();
  EXPECT_NEAR(simulation.world().level_range_m(2.0, 3.0, 0.3, std::atan2(2.0, 1.5), own), 0.32, 0.02);
  EXPECT_EQ(simulation.body(0).collisions(), 0U);
}

// The bar: odometry alone is at least 5 m wrong after 450 s.
TEST(Simulation, OdometryAloneIsLostAfter450Seconds) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    auto world = World::load(std::string(TOPO_SOURCE_DIR) + "/config/worlds/office.toml");
    ASSERT_TRUE(world.has_value()) << world.error().message;
    WayPointDrive drive({{25.0, 7.0},
                         {25.0, 13.0},
                         {40.0, 13.0},
                         {25.0, 13.0},
                         {25.0, 19.0},
                         {13.0, 19.0},
                         {13.0, 30.0},
                         {13.0, 19.0},
                         {1.1, 19.0},
                         {1.1, 7.0}},
                        0);
    Simulation simulation(std::move(*world), Difficulty{}, seed);
    RobotSetup setup;
    setup.start = simulation.world().start_poses()[0];
    setup.drive = &drive;
    ASSERT_TRUE(simulation.add_robot(setup).has_value());
    const RobotBody& body = simulation.body(0);
    DeadReckoning reckoning(setup.start, body.model().track_m);
    std::vector<Se2> truth;
    std::vector<Se2> reckoned;
    for (SimTime t{0}; t <= SimTime{450'000'000'000}; t += SimTime{10'000'000}) {
      simulation.advance_to(t);
      reckoning.update(body);
      truth.push_back(body.truth());
      reckoned.push_back(reckoning.pose());
    }
    const double error_m = (reckoning.pose().translation() - body.truth().translation()).norm();
    RecordProperty(fmt::format("odometry_error_m_seed_{}", seed), fmt::format("{:.2f}", error_m));
    fmt::print("seed {}: {:.1f} m driven, odometry {:.1f} m and {:.0f} degrees wrong, {} collisions\n", seed,
               body.path_m(), error_m,
               57.29578 * std::abs(types::wrap_angle(reckoning.pose().theta_rad - body.truth().theta_rad)),
               body.collisions());
    EXPECT_GT(body.path_m(), 150.0);
    EXPECT_GE(error_m, 5.0) << "seed " << seed;
    if (seed == 1) {
      Picture picture(simulation.world().extents(), 0.05);
      picture.world(simulation.world());
      picture.path(truth, kTruthInk);
      picture.path(reckoned, kEstimateInk);
      EXPECT_TRUE(picture.save_png(testing::TempDir() + "odometry_alone.png").has_value());
    }
  }
}

TEST(Difficulty, SaysInReportsWhetherItIsTheFixedOne) {
  EXPECT_EQ(Difficulty{}.text().find("CHANGED"), std::string::npos);
  EXPECT_NE(Difficulty{}.text().find("30 mm to 10 m and 50 mm beyond"), std::string::npos);
  Difficulty easy;
  easy.dropout_probability = 0.0;
  EXPECT_EQ(easy.text().find("CHANGED"), 0U);
}

}  // namespace
}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "tests/sim/laser.hpp"
#include "tests/sim/robot_body.hpp"
#include "tests/sim/sonar.hpp"
#include "tests/sim/world.hpp"

namespace topo::sim {

struct WheelSpeeds {
  double left_mps = 0.0;
  double right_mps = 0.0;
};

/// The firmware's side of the wheels. Called once per step, in the thread that advances the simulation.
class WheelDrive {
 public:
  virtual ~WheelDrive() = default;
  /// Encoder speeds for the step of `dt` that begins at `now`; `body` is in its state after the last step.
  virtual WheelSpeeds wheel_speeds(SimTime now, SimTime dt, const RobotBody& body) = 0;
};

/// Takes the measurements of the sensors, in the thread that advances the simulation, in order of time.
class SensorSink {
 public:
  virtual ~SensorSink() = default;
  /// A sweep of the robot's laser number `laser` has ended; the object is reused for the next one.
  virtual void on_sweep(std::size_t laser, const Sweep& sweep) = 0;
  virtual void on_sonar(const SonarEcho& echo) = 0;
};

struct LaserSetup {
  LaserModel model = LaserModel::utm_30lx();
  LaserMount mount;
  SimTime phase{0};  ///< time of step 0 of the first sweep
};

struct RobotSetup {
  RobotModel model = RobotModel::p3dx();
  Se2 start;
  std::vector<LaserSetup> lasers;
  WheelDrive* drive = nullptr;  ///< not owned; null: the robot stands
  SensorSink* sink = nullptr;   ///< not owned; null: nothing is measured
};

/// A person who walks from way-point to way-point in a loop, and waits when a robot is in the way.
struct Walker {
  std::vector<Vector2> way_points;
  double speed_mps = 1.0;
  double radius_m = 0.25;
  double height_m = 1.75;
};

/// A building with robots, simulated in steps of fixed size: the same seed and the same wheel speeds give
/// identical bytes, however the time is divided into calls. Not thread-safe.
class Simulation {
 public:
  static constexpr SimTime kStep{1'000'000};

  Simulation(World world, const Difficulty& difficulty, std::uint64_t seed);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Index of the robot; an error when it would collide with something.
  types::Result<std::size_t> add_robot(const RobotSetup& setup);
  /// Replaces a robot's sink or drive (null: none).
  void set_sink(std::size_t robot, SensorSink* sink);
  void set_drive(std::size_t robot, WheelDrive* drive);

  /// Adds a box or cylinder; an error when it would overlap a robot.
  types::Result<MovableId> add_obstacle(const Prism& prism);
  /// The same for a box of 0.4 m, `distance_m` ahead of the robot's front.
  types::Result<MovableId> add_box_ahead(std::size_t robot, double distance_m);
  /// An error when no obstacle has this number: robots and people are not obstacles.
  types::Status remove_obstacle(MovableId id);
  void add_walker(Walker walker);
  /// Removes all walkers.
  void remove_walkers();

  /// Steps until `time` is less than one step away. Earlier times have no effect.
  void advance_to(SimTime time);

  [[nodiscard]] SimTime now() const { return now_; }
  [[nodiscard]] std::size_t robot_count() const { return robots_.size(); }
  [[nodiscard]] RobotBody& body(std::size_t robot);
  [[nodiscard]] const RobotBody& body(std::size_t robot) const;
  [[nodiscard]] const LaserSimulator& laser(std::size_t robot, std::size_t laser) const;
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const Difficulty& difficulty() const { return difficulty_; }
  [[nodiscard]] std::uint64_t seed() const { return seed_; }

 private:
  struct Robot;
  struct Person;
  void step();
  void step_walker(Person& person);
  void measure(Robot& robot);

  World world_;
  Difficulty difficulty_;
  std::uint64_t seed_;
  SimTime now_{0};
  std::vector<std::unique_ptr<Robot>> robots_;
  std::vector<std::unique_ptr<Person>> people_;
  std::set<MovableId> obstacles_;
};

}  // namespace topo::sim

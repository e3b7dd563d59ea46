// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/simulation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <utility>

namespace topo::sim {

struct Simulation::Robot {
  struct Laser {
    LaserSimulator simulator;
    SimTime next_step0;
    std::uint64_t number = 0;
    Sweep sweep;
  };
  std::unique_ptr<RobotBody> body;
  std::vector<Laser> lasers;
  Random sonar_random;
  SimTime next_sonar{0};
  int sonar_turn = 0;
  WheelDrive* drive = nullptr;
  SensorSink* sink = nullptr;
};

struct Simulation::Person {
  Walker walker;
  Vector2 at{0.0, 0.0};
  std::size_t towards = 0;
  MovableId movable = kNoMovable;
};

Simulation::Simulation(World world, const Difficulty& difficulty, std::uint64_t seed)
    : world_(std::move(world)), difficulty_(difficulty), seed_(seed) {}

Simulation::~Simulation() = default;

types::Result<std::size_t> Simulation::add_robot(const RobotSetup& setup) {
  const Touch touch =
      world_.touch(setup.model.footprint(), setup.start, setup.model.clearance_m, setup.model.height_m);
  if (touch.touching || world_.structure().at(setup.start.translation()) == 0) {
    return types::fail(
        types::Errc::kInvalidInput,
        fmt::format("world '{}': a {} at ({:g}, {:g}) would stand in something; expected a free start",
                    world_.name(), setup.model.subclass, setup.start.x_m, setup.start.y_m));
  }
  const std::size_t index = robots_.size();
  const std::uint64_t seed = derive_seed(seed_, index + 1);
  auto robot = std::make_unique<Robot>(
      Robot{nullptr, {}, Random(derive_seed(seed, 2)), now_, 0, setup.drive, setup.sink});
  robot->body =
      std::make_unique<RobotBody>(world_, setup.model, setup.start, difficulty_, derive_seed(seed, 1));
  robot->body->start_clock(now_);
  for (std::size_t i = 0; i < setup.lasers.size(); ++i) {
    const LaserSetup& laser = setup.lasers[i];
    robot->lasers.push_back({LaserSimulator(world_, laser.model, laser.mount, difficulty_,
                                            derive_seed(seed, 100 + i), robot->body->movable()),
                             now_ + laser.phase,
                             0,
                             {}});
  }
  robots_.push_back(std::move(robot));
  return index;
}

void Simulation::set_sink(std::size_t robot, SensorSink* sink) { robots_.at(robot)->sink = sink; }
void Simulation::set_drive(std::size_t robot, WheelDrive* drive) { robots_.at(robot)->drive = drive; }

types::Result<MovableId> Simulation::add_obstacle(const Prism& prism) {
  const MovableId id = world_.add_movable(prism);
  for (const auto& robot : robots_) {
    const RobotBody& body = *robot->body;
    if (!world_
             .touch(body.model().footprint(), body.truth(), body.model().clearance_m, body.model().height_m,
                    body.movable())
             .touching &&
        !contains(prism.outline, body.truth().translation())) {
      continue;
    }
    world_.remove_movable(id);
    return types::fail(types::Errc::kInvalidInput,
                       "the obstacle would overlap a robot; expected a free place");
  }
  obstacles_.insert(id);
  return id;
}

types::Result<MovableId> Simulation::add_box_ahead(std::size_t robot, double distance_m) {
  constexpr double kSize_m = 0.4;
  const RobotBody& body = *robots_.at(robot)->body;
  const Se2 center = body.truth() * Se2{body.model().length_front_m + distance_m + 0.5 * kSize_m, 0.0, 0.0};
  return add_obstacle(make_box(center, kSize_m, kSize_m, 0.0, 1.0));
}

types::Status Simulation::remove_obstacle(MovableId id) {
  if (obstacles_.erase(id) == 0) {
    return types::fail(types::Errc::kInvalidInput,
                       obstacles_.empty()
                           ? fmt::format("found id {}, but there is no obstacle to remove", id)
                           : fmt::format("found id {}, expected one of {}", id, fmt::join(obstacles_, ", ")));
  }
  world_.remove_movable(id);
  return {};
}

void Simulation::add_walker(Walker walker) {
  if (walker.way_points.empty()) return;
  auto person = std::make_unique<Person>();
  person->at = walker.way_points.front();
  person->movable = world_.add_movable(make_cylinder(person->at, walker.radius_m, 0.0, walker.height_m));
  person->walker = std::move(walker);
  people_.push_back(std::move(person));
}

void Simulation::remove_walkers() {
  for (const auto& person : people_) world_.remove_movable(person->movable);
  people_.clear();
}

void Simulation::step_walker(Person& person) {
  const Vector2 target = person.walker.way_points[person.towards];
  const Vector2 rest = target - person.at;
  const double step_m = person.walker.speed_mps * types::to_seconds(kStep);
  if (rest.norm() <= step_m) {
    person.towards = (person.towards + 1) % person.walker.way_points.size();
    return;
  }
  const Vector2 next = person.at + rest.normalized() * step_m;
  const bool in_the_way = std::any_of(robots_.begin(), robots_.end(), [&](const auto& robot) {
    return (robot->body->truth().translation() - next).norm() <
           robot->body->model().swing_radius_m + person.walker.radius_m + 0.05;
  });
  if (in_the_way) return;
  person.at = next;
  world_.move_movable(person.movable,
                      make_cylinder(next, person.walker.radius_m, 0.0, person.walker.height_m));
}

void Simulation::advance_to(SimTime time) {
  while (now_ + kStep <= time) step();
}

void Simulation::step() {
  for (const auto& person : people_) step_walker(*person);
  for (const auto& robot : robots_) {
    const WheelSpeeds speeds =
        robot->drive != nullptr ? robot->drive->wheel_speeds(now_, kStep, *robot->body) : WheelSpeeds{};
    robot->body->step(types::to_seconds(kStep), speeds.left_mps, speeds.right_mps);
  }
  now_ += kStep;
  for (const auto& robot : robots_) measure(*robot);
}

void Simulation::measure(Robot& robot) {
  const auto pose_at = [&robot](SimTime t) { return robot.body->pose_at(t); };
  for (std::size_t i = 0; i < robot.lasers.size(); ++i) {
    Robot::Laser& laser = robot.lasers[i];
    const LaserModel& model = laser.simulator.model();
    if (now_ < laser.next_step0 + model.step_time(model.step_max)) continue;
    if (robot.sink != nullptr) {
      laser.simulator.measure(laser.next_step0, laser.number, pose_at, laser.sweep);
      robot.sink->on_sweep(i, laser.sweep);
    }
    laser.next_step0 += model.period();
    ++laser.number;
  }
  if (now_ < robot.next_sonar) return;
  robot.next_sonar += kSonarCycle;
  for (const int index : {robot.sonar_turn, robot.sonar_turn + 8}) {
    const SonarEcho echo = measure_sonar(world_, robot.body->model(), robot.body->truth(), index, now_,
                                         difficulty_, robot.sonar_random, robot.body->movable());
    if (robot.sink != nullptr) robot.sink->on_sonar(echo);
  }
  robot.sonar_turn = (robot.sonar_turn + 1) % 8;
}

RobotBody& Simulation::body(std::size_t robot) { return *robots_.at(robot)->body; }
const RobotBody& Simulation::body(std::size_t robot) const { return *robots_.at(robot)->body; }
const LaserSimulator& Simulation::laser(std::size_t robot, std::size_t laser) const {
  return robots_.at(robot)->lasers.at(laser).simulator;
}

}  // namespace topo::sim

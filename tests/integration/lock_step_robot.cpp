// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/lock_step_robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "tests/sim/devices/sweep_turn.hpp"

namespace topo::test {
namespace {

constexpr types::Duration kTick = std::chrono::milliseconds(1);
constexpr std::size_t kMost = 4096;  ///< bytes that a wire hands over at once

class LockStepStream final : public io::ByteStream {
 public:
  LockStepStream(LockStepRobot& robot, LockStepRobot::Line& line) : robot_(robot), line_(line) {}

  types::Result<io::ReadResult> read(std::span<std::byte> buffer, types::Duration timeout) override {
    const types::Stamp deadline = robot_.now() + timeout;
    while (line_.arrived.empty() && robot_.now() < deadline) robot_.advance_to(robot_.now() + kTick);
    if (line_.arrived.empty()) return io::ReadResult{0, robot_.now()};
    LockStepRobot::Arrived& front = line_.arrived.front();
    const std::size_t n = std::min(buffer.size(), front.bytes.size());
    std::memcpy(buffer.data(), front.bytes.data(), n);
    const types::Stamp stamp = front.stamp;
    front.bytes.erase(0, n);
    if (front.bytes.empty()) line_.arrived.pop_front();
    return io::ReadResult{n, stamp};
  }
  types::Status write(std::span<const std::byte> bytes, types::Duration) override {
    std::vector<std::uint8_t> copy(bytes.size());
    std::memcpy(copy.data(), bytes.data(), bytes.size());
    line_.device->receive(copy, robot_.now().time_since_epoch());
    return {};
  }
  types::Status set_baud(int) override { return {}; }
  [[nodiscard]] bool has_baud() const override { return false; }
  [[nodiscard]] types::Stamp now() const override { return robot_.now(); }

 private:
  LockStepRobot& robot_;
  LockStepRobot::Line& line_;
};

class LockStepConnector final : public io::Connector {
 public:
  LockStepConnector(LockStepRobot& robot, LockStepRobot::Line& line) : robot_(robot), line_(line) {}
  types::Result<std::unique_ptr<io::ByteStream>> connect(types::Duration) override {
    return std::make_unique<LockStepStream>(robot_, line_);
  }
  [[nodiscard]] std::string_view name() const override { return "lock-step"; }
  [[nodiscard]] types::Stamp now() const override { return robot_.now(); }
  void pause(types::Duration duration) override { robot_.advance_to(robot_.now() + duration); }

 private:
  LockStepRobot& robot_;
  LockStepRobot::Line& line_;
};

sim::arcos::Parameters parameters_of(const std::string& model) {
  return model == "p3at" ? sim::arcos::p3at_parameters() : sim::arcos::p3dx_parameters();
}

sim::ScipOptions scanner() {
  sim::ScipOptions options{};
  options.model = sim::ScipModel::kUtm30LxEw;
  options.serial = "H0902680";
  return options;
}

}  // namespace

LockStepRobot::LockStepRobot(sim::World world, const LockStepSetup& setup, std::uint64_t seed)
    : simulation_(std::move(world), setup.difficulty, seed),
      base_(parameters_of(setup.model), seed),
      front_(scanner()),
      base_line_{&base_, {}},
      front_line_{&front_, {}} {
  sim::RobotSetup robot;
  robot.model = setup.model == "p3at" ? sim::RobotModel::p3at() : sim::RobotModel::p3dx();
  robot.start = simulation_.world().start_poses().front();
  if (setup.has_front) robot.lasers = {{sim::LaserModel::utm_30lx_ew(), setup.front, sim::SimTime{0}}};
  robot.drive = this;
  robot.sink = this;
  if (const auto added = simulation_.add_robot(robot); !added) {
    ADD_FAILURE() << added.error().message;
    std::abort();
  }
}

LockStepRobot::~LockStepRobot() {
  simulation_.set_sink(0, nullptr);
  simulation_.set_drive(0, nullptr);
}

std::unique_ptr<io::Connector> LockStepRobot::base_connector() {
  return std::make_unique<LockStepConnector>(*this, base_line_);
}
std::unique_ptr<io::Connector> LockStepRobot::front_connector() {
  return std::make_unique<LockStepConnector>(*this, front_line_);
}

void LockStepRobot::deliver(Line& line) {
  const sim::SimTime now = simulation_.now();
  line.device->tick(now);
  std::string bytes;
  for (auto more = line.device->output().peek(now, kMost); !more.empty();
       more = line.device->output().peek(now, kMost)) {
    bytes += more;
    line.device->output().consume(more.size());
  }
  if (!bytes.empty()) line.arrived.push_back({types::Stamp{now}, std::move(bytes)});
}

void LockStepRobot::advance_to(types::Stamp time) {
  while (now() < time) {
    simulation_.advance_to(simulation_.now() + kTick);
    deliver(base_line_);
    deliver(front_line_);
  }
}

sim::WheelSpeeds LockStepRobot::wheel_speeds(sim::SimTime now, sim::SimTime dt, const sim::RobotBody& body) {
  const sim::BaseInputs inputs{.left_m = body.encoder_left_m(),
                               .right_m = body.encoder_right_m(),
                               .left_mps = body.encoder_left_mps(),
                               .right_mps = body.encoder_right_mps(),
                               .left_stall = false,
                               .right_stall = false,
                               .front_bumpers = 0,
                               .rear_bumpers = 0,
                               .omega_radps = body.true_twist().omega_radps};
  const auto wanted = base_.control(now, dt, inputs);
  return {wanted.left_mps, wanted.right_mps};
}

void LockStepRobot::on_sweep(std::size_t, const sim::Sweep& sweep) {
  if (!front_.laser_on()) return;
  sim::fill_turn(sweep, turn_);
  front_.deliver(turn_, sweep.end);
}

}  // namespace topo::test

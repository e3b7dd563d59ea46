// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/robot_rig.hpp"

#include <cstdio>

#include "tests/sim/devices/sweep_turn.hpp"
#include "tests/sim/random.hpp"

namespace topo::sim {
namespace {

/// The mirrors of two sensors are not in phase.
constexpr SimTime kCoronalPhase = std::chrono::microseconds{9300};

LaserModel laser_model(ScipModel model) {
  switch (model) {
    case ScipModel::kUtm30Lx:
      return LaserModel::utm_30lx();
    case ScipModel::kUtm30LxEw:
      return LaserModel::utm_30lx_ew();
    case ScipModel::kUst10Lx:
      return LaserModel::ust_10lx();
    case ScipModel::kUst20Lx:
      return LaserModel::ust_20lx();
    case ScipModel::kUrg04Lx:
      return LaserModel::urg_04lx();
  }
  return LaserModel::utm_30lx();
}

arcos::Parameters base_parameters(const RobotConfig& config, std::size_t number) {
  arcos::Parameters p = config.model == "p3at" ? arcos::p3at_parameters() : arcos::p3dx_parameters();
  p.watchdog_ms = config.watchdog_ms;
  p.battery_volts = config.battery_volts;
  if (number > 0) p.robot_name += std::to_string(number);
  return p;
}

std::string serial_number(std::size_t robot, std::size_t laser) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "H%07zu", 902680 + 10 * robot + laser);
  return text.data();
}

/// The crystals are off by 20 to 100 ppm in either direction, and the sensor has already run for some time
/// (PROTOCOLS section 12).
ScipOptions laser_options(ScipModel model, std::string serial, std::uint64_t seed) {
  Random random(seed);
  const double drift_ppm = random.uniform(20.0, 100.0) * (random.uniform() < 0.5 ? -1.0 : 1.0);
  return {.model = model,
          .serial = std::move(serial),
          .clock_offset_ms = random.uniform(1e3, 1e7),
          .clock_drift_ppm = drift_ppm,
          .scans_behind_quit = static_cast<int>(random.next() % 3)};
}

std::unique_ptr<Endpoint> make_endpoint(const LinkConfig& link, const ArcosDevice& base) {
  if (!link.can_interface.empty()) {
    return make_can_endpoint(link.can_interface, link.can_unit,
                             [&base] { return static_cast<int>(base.state()); });
  }
  return link.tcp_port ? make_tcp_endpoint(*link.tcp_port) : make_pty_endpoint(link.pty_link);
}

}  // namespace

RobotConfig tcp_robot() {
  RobotConfig config;
  for (LinkConfig& link : config.links) link.tcp_port = 0;
  return config;
}

RobotConfig can_robot(const std::string& interface) {
  RobotConfig config = tcp_robot();
  config.links[static_cast<std::size_t>(DeviceId::kBase)].can_interface = interface;
  return config;
}

RobotConfig pty_robot(const std::filesystem::path& folder) {
  RobotConfig config;
  config.front = config.coronal = ScipModel::kUtm30Lx;
  config.links[0].pty_link = folder / "laser_front";
  config.links[1].pty_link = folder / "laser_coronal";
  config.links[2].pty_link = folder / "base";
  return config;
}

RobotRig::RobotRig(const RobotConfig& config, std::size_t number, std::uint64_t seed)
    : config_(config),
      number_(number),
      seed_(seed),
      base_(base_parameters(config, number), derive_seed(seed, 1)) {
  const std::array models{config.front, config.coronal};
  for (std::size_t i = 0; i < lasers_.size(); ++i) {
    serials_[i] = serial_number(number, i);
    lasers_[i] = std::make_unique<ScipDevice>(laser_options(models[i], serials_[i], derive_seed(seed, 2, i)));
  }
  const std::array<WireDevice*, kDeviceCount> devices{lasers_[0].get(), lasers_[1].get(), &base_};
  for (std::size_t i = 0; i < kDeviceCount; ++i) {
    wires_[i] =
        std::make_unique<Wire>(*devices[i], make_endpoint(config.links[i], base_), derive_seed(seed, 3, i));
  }
}

RobotSetup RobotRig::setup(const types::Se2& start) {
  RobotSetup setup;
  setup.model = config_.model == "p3at" ? RobotModel::p3at() : RobotModel::p3dx();
  setup.start = start;
  setup.lasers = {{laser_model(config_.front), config_.front_mount, SimTime{0}},
                  {laser_model(config_.coronal), config_.coronal_mount, kCoronalPhase}};
  setup.drive = this;
  setup.sink = this;
  return setup;
}

types::Status RobotRig::open() {
  for (auto& wire : wires_) {
    if (auto status = wire->open(); !status.has_value()) return status;
  }
  return {};
}

void RobotRig::pump(SimTime now) {
  for (auto& wire : wires_) wire->pump(now);
}

void RobotRig::append_poll(std::vector<pollfd>& fds) const {
  for (const auto& wire : wires_) wire->append_poll(fds);
}

WheelSpeeds RobotRig::wheel_speeds(SimTime now, SimTime dt, const RobotBody& body) {
  const Contact& contact = body.contact();
  const BaseInputs inputs{.left_m = body.encoder_left_m(),
                          .right_m = body.encoder_right_m(),
                          .left_mps = body.encoder_left_mps(),
                          .right_mps = body.encoder_right_mps(),
                          .left_stall = contact.stall_left,
                          .right_stall = contact.stall_right,
                          .front_bumpers = contact.bumpers_front,
                          .rear_bumpers = contact.bumpers_rear,
                          .omega_radps = body.true_twist().omega_radps};
  const auto wanted = base_.control(now, dt, inputs);
  return {wanted.left_mps, wanted.right_mps};
}

void RobotRig::exchange_scanners() {
  exchanged_ = !exchanged_;
  for (const DeviceId id : {DeviceId::kFront, DeviceId::kCoronal}) set_foreign(id, false);
}

void RobotRig::set_foreign(DeviceId id, bool foreign) {
  if (id == DeviceId::kBase) {
    const arcos::Parameters own = base_parameters(config_, number_);
    base_.set_identity(foreign ? own.robot_name + "_other" : own.robot_name,
                       foreign ? "OTHER_1" : own.serial);
    return;
  }
  const auto at = static_cast<std::size_t>(id);
  lasers_[at]->set_serial(foreign ? "H9999999" : serials_[exchanged_ ? 1 - at : at]);
}

void RobotRig::on_sweep(std::size_t laser, const Sweep& sweep) {
  ScipDevice& device = *lasers_[exchanged_ ? 1 - laser : laser];
  if (!device.laser_on()) return;
  fill_turn(sweep, turn_);
  device.deliver(turn_, sweep.end);
}

void RobotRig::on_sonar(const SonarEcho& echo) { base_.add_sonar(echo.index, echo.range_m); }

}  // namespace topo::sim

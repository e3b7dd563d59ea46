// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Session, motor loop and SIPs; the commands are in arcos_commands.cpp.
#include "tests/sim/devices/arcos_device.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/types/se2.hpp"

namespace topo::sim {
namespace {

constexpr std::size_t kSerialOutputLimit = 4096;
constexpr std::size_t kSonarMost = 32;
constexpr double kPi = std::numbers::pi;

int to_mm_s(double mps) { return static_cast<int>(mps * 1e3); }

}  // namespace

ArcosDevice::ArcosDevice(arcos::Parameters parameters, std::uint64_t seed)
    : parameters_(std::move(parameters)),
      drive_(parameters_),
      output_(kSerialOutputLimit),
      random_(seed),
      baud_code_(parameters_.host_baud_code),
      gyro_(seed) {}

void ArcosDevice::receive(std::span<const std::uint8_t> bytes, SimTime now) {
  bytes_heard_ += bytes.size();
  receiver_.feed(bytes, [this, now](const arcos::Command& command) { handle(command, now); });
}

bool ArcosDevice::watchdog_holds(SimTime now) const {
  return parameters_.watchdog_ms > 0 &&
         now - last_packet_ > std::chrono::milliseconds{parameters_.watchdog_ms};
}

void ArcosDevice::open_session(SimTime now) {
  state_ = State::kOpen;
  next_sip_ = now + std::chrono::milliseconds{parameters_.sip_cycle_ms};
  enable_motors(false);
  sonar_arrays_ = 3;
  sonar_.clear();
  x_mm_ = y_mm_ = heading_rad_ = 0.0;
}

void ArcosDevice::close_session() {
  state_ = State::kWait;
  sync_index_ = 0;
  enable_motors(false);
  drive_.revert();
  sonar_arrays_ = 0;
  encoder_stream_ = io_stream_ = 0;
  gyro_stream_ = false;
  e_stall_ = true;
  bump_stall_mode_ = 0;
  // Only the change by AutoBaud 2 reverts when the link closes (PROTOCOLS section 1.2).
  if (parameters_.auto_baud == 2) baud_code_ = parameters_.host_baud_code;
}

void ArcosDevice::controller_reset(SimTime now) {
  close_session();
  output_.clear();
  receiver_.clear();
  baud_code_ = parameters_.host_baud_code;
  stall_by_button_ = false;
  x_mm_ = y_mm_ = heading_rad_ = 0.0;
  output_.push(arcos::PacketBuilder(0xFF).frame(), now);
}

void ArcosDevice::power_cycle(SimTime now) { controller_reset(now); }

void ArcosDevice::enable_motors(bool on) {
  if (on && stop_button_ && e_stall_) return;
  motors_on_ = on;
  bump_stalled_ = false;
  if (on) {
    stall_by_button_ = false;
  } else {
    drive_.stop();
    drive_.stand();
  }
}

void ArcosDevice::set_stop_button(bool pressed) {
  stop_button_ = pressed;
  if (!pressed || !e_stall_) return;
  enable_motors(false);
  stall_by_button_ = true;
}

void ArcosDevice::press_bumpers(std::uint8_t front, std::uint8_t rear, SimTime until) {
  pressed_front_ = front;
  pressed_rear_ = rear;
  pressed_until_ = until;
}

void ArcosDevice::set_battery(double volts, double fall_vps, SimTime now) {
  parameters_.battery_volts = volts;
  faults_.battery_fall_vps = fall_vps;
  faults_.battery_since = now;
}

void ArcosDevice::set_identity(std::string robot_name, std::string serial) {
  parameters_.robot_name = std::move(robot_name);
  parameters_.serial = std::move(serial);
}

BaseInputs ArcosDevice::faulty(BaseInputs inputs, SimTime now) {
  inputs.left_m = faults_.left.count_m(inputs.left_m);
  inputs.right_m = faults_.right.count_m(inputs.right_m);
  if (faults_.left.dead()) inputs.left_mps = 0.0;
  if (faults_.right.dead()) inputs.right_mps = 0.0;
  if (now < faults_.stalled_until) {
    inputs.left_stall = inputs.left_stall || faults_.stall_left;
    inputs.right_stall = inputs.right_stall || faults_.stall_right;
  }
  return inputs;
}

void ArcosDevice::add_sonar(int index, double range_m) {
  constexpr int kArraySize = 8;
  const unsigned array = static_cast<unsigned>(index / kArraySize);
  if (state_ != State::kOpen || index < 0 || (sonar_arrays_ >> array & 1U) == 0 ||
      sonar_.size() >= kSonarMost)
    return;
  sonar_.push_back({index, static_cast<int>(faults_.sonar_stuck_m.value_or(range_m) * 1e3)});
}

void ArcosDevice::dead_reckon(const BaseInputs& inputs) {
  const double ticks_per_m = parameters_.ticks_per_mm * 1e3;
  const auto left = static_cast<std::int64_t>(std::floor(inputs.left_m * ticks_per_m));
  const auto right = static_cast<std::int64_t>(std::floor(inputs.right_m * ticks_per_m));
  if (have_ticks_) {
    const double left_mm = static_cast<double>(left - left_ticks_) / parameters_.ticks_per_mm;
    const double right_mm = static_cast<double>(right - right_ticks_) / parameters_.ticks_per_mm;
    const double way = (left_mm + right_mm) / 2.0;
    const double turn = (right_mm - left_mm) / parameters_.track_mm;
    way_mm_ += way;
    x_mm_ += way * std::cos(heading_rad_ + turn / 2.0);
    y_mm_ += way * std::sin(heading_rad_ + turn / 2.0);
    heading_rad_ = std::remainder(heading_rad_ + turn, 2.0 * kPi);
  }
  have_ticks_ = true;
  left_ticks_ = left;
  right_ticks_ = right;
}

arcos::Reckoning ArcosDevice::reckoning() const { return {way_mm_, heading_rad_ / topo::types::kDegree_rad}; }

void ArcosDevice::bump_stall() {
  const bool front =
      inputs_.front_bumpers != 0 && drive_.velocity_setpoint_mm_s() > 0 && (bump_stall_mode_ & 1) != 0;
  const bool rear =
      inputs_.rear_bumpers != 0 && drive_.velocity_setpoint_mm_s() < 0 && (bump_stall_mode_ & 2) != 0;
  if (front || rear) {
    drive_.emergency_stop();
    bump_stalled_ = true;
  } else if (inputs_.front_bumpers == 0 && inputs_.rear_bumpers == 0) {
    bump_stalled_ = false;
  }
}

arcos::WheelTargets ArcosDevice::control(SimTime now, SimTime dt, const BaseInputs& inputs) {
  inputs_ = faulty(inputs, now);
  if (now < pressed_until_) {
    inputs_.front_bumpers |= pressed_front_;
    inputs_.rear_bumpers |= pressed_rear_;
  }
  dead_reckon(inputs_);
  gyro_.feel(now, inputs_.omega_radps);
  bump_stall();
  tick(now);
  if (state_ != State::kOpen || !motors_on_) {
    drive_.stand();
    return {};
  }
  if (now < faults_.stalled_until && (faults_.stall_left || faults_.stall_right)) {
    drive_.blocked(0.0, 0.0);
    return {};
  }
  return drive_.step(seconds_of(dt), watchdog_holds(now), reckoning());
}

void ArcosDevice::tick(SimTime now) {
  if (state_ != State::kOpen || now < next_sip_) return;
  send_sip(now);
  // 100 ms with a jitter of one millisecond (PROTOCOLS section 8); missed cycles are not repeated.
  const SimTime cycle = std::chrono::milliseconds{parameters_.sip_cycle_ms};
  const auto jitter_us = static_cast<std::int64_t>(random_() % 2001) - 1000;
  next_sip_ = std::max(next_sip_ + cycle, now + cycle / 2) + std::chrono::microseconds{jitter_us};
}

void ArcosDevice::send_sip(SimTime now) {
  // The fixed difficulty: a SIP leaves 20 to 60 ms after its data were sampled.
  const auto late_us = 20000 + static_cast<std::int64_t>(random_() % 40001);
  const SimTime due = now + std::chrono::microseconds{late_us};
  constexpr int kWarm = 30;
  if (const auto readings = gyro_.take(); gyro_stream_)
    output_.push_droppable(arcos::gyro_packet(readings, kWarm), due);
  output_.push_droppable(arcos::sip_packet(compose_sip(now)), due);
  if (encoder_stream_ != 0) {
    output_.push_droppable(arcos::encoder_packet(static_cast<std::int32_t>(left_ticks_),
                                                 static_cast<std::int32_t>(right_ticks_)),
                           due);
    if (encoder_stream_ == 1) encoder_stream_ = 0;
  }
  if (io_stream_ != 0) {
    output_.push_droppable(arcos::io_packet(0xFF, inputs_.front_bumpers, inputs_.rear_bumpers, digout_), due);
    if (io_stream_ == 1) io_stream_ = 0;
  }
}

arcos::Sip ArcosDevice::compose_sip(SimTime now) {
  constexpr double kHeadingCounts = 4096.0;
  arcos::Sip sip;
  sip.left_mm_s = to_mm_s(inputs_.left_mps);
  sip.right_mm_s = to_mm_s(inputs_.right_mps);
  sip.moving = sip.left_mm_s != 0 || sip.right_mm_s != 0;
  sip.x_mm = static_cast<int>(x_mm_);
  sip.y_mm = static_cast<int>(y_mm_);
  sip.heading_counts = static_cast<int>(heading_rad_ / (2.0 * kPi) * kHeadingCounts);
  sip.battery_dv = static_cast<int>(std::lround(faults_.battery_v(parameters_.battery_volts, now) * 10.0));
  sip.stall_bump = stall_bump_bits();
  sip.flags = flag_bits();
  sip.sonar.swap(sonar_);
  const double turn_rad_s = (inputs_.right_mps - inputs_.left_mps) * 1e3 / parameters_.track_mm;
  sip.rotation_ddeg_s = static_cast<int>(turn_rad_s * 1800.0 / kPi);
  faults_.spoil(sip, sips_++, parameters_.track_mm);
  return sip;
}

int ArcosDevice::stall_bump_bits() const {
  constexpr int kLeftStall = 1 << 0;
  constexpr int kRightStall = 1 << 8;
  const bool button = stop_button_ && e_stall_;
  int bits = 0;
  if (inputs_.left_stall || button || bump_stalled_) bits |= kLeftStall;
  if (inputs_.right_stall || button || bump_stalled_) bits |= kRightStall;
  return bits | ((inputs_.rear_bumpers & 0x7F) << 1) | ((inputs_.front_bumpers & 0x7F) << 9);
}

int ArcosDevice::flag_bits() const {
  int bits = motors_on_ ? 1 : 0;
  bits |= static_cast<int>(sonar_arrays_ & 0xFU) << 1;
  if (stop_button_) bits |= 1 << 5;
  if (stall_by_button_) bits |= 1 << 6;
  return bits;
}

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Effects of the commands on the firmware (PROTOCOLS sections 2 and 3).
#include <algorithm>
#include <array>
#include <string>

#include "tests/sim/devices/arcos_device.hpp"

namespace topo::sim {
namespace {

enum Number : std::uint8_t {
  kPulse = 0,
  kOpenSession = 1,
  kClose = 2,
  kEnable = 4,
  kSetA = 5,
  kSetV = 6,
  kSetOrigin = 7,
  kMove = 8,
  kRotate = 9,
  kSetRv = 10,
  kVel = 11,
  kHead = 12,
  kDhead = 13,
  kConfig = 18,
  kEncoder = 19,
  kRvel = 21,
  kDchead = 22,
  kSetRa = 23,
  kSonar = 28,
  kStop = 29,
  kDigout = 30,
  kVel2 = 32,
  kIoRequest = 40,
  kBumpStall = 44,
  kHostBaud = 50,
  kEStop = 55,
  kEStall = 56,
  kQStop = 57,
  kGyro = 58,
  kBatteryTest = 250,
  kReset = 253
};
constexpr int kMoveMost_mm = 5000;  // PROTOCOLS section 3
constexpr std::uint8_t kSyncSteps = 3;
constexpr std::uint8_t kWrongSync = 0xFF;

/// The two signed bytes of VEL2; both forms of a negative argument give the same 16 bits (PROTOCOLS 1.1).
int signed_byte(int value, int shift) { return static_cast<std::int8_t>(value >> shift & 0xFF); }

}  // namespace

bool ArcosDevice::swallows(const arcos::Command& command) {
  static constexpr std::array<std::uint8_t, 11> kMotion{kMove,   kRotate, kVel,  kHead,  kDhead, kRvel,
                                                        kDchead, kStop,   kVel2, kEStop, kQStop};
  return faults_.disobeys && std::find(kMotion.begin(), kMotion.end(), command.number) != kMotion.end();
}

void ArcosDevice::handle(const arcos::Command& command, SimTime now) {
  if (faults_.lost_commands > 0.0 && std::uniform_real_distribution<>()(random_) < faults_.lost_commands)
    return;
  last_packet_ = now;  // any valid packet resets the watchdog, and the earlier setpoint resumes
  if (command.number == kEStop) ++e_stops_;
  if (swallows(command)) return;
  if (state_ == State::kOpen) return handle_open(command, now);
  handle_sync(command, now);
}

void ArcosDevice::handle_sync(const arcos::Command& command, SimTime now) {
  const std::uint8_t number = command.number;
  if (number == kClose && command.has_argument) {
    state_ = State::kWait;
    sync_index_ = 0;
    return;
  }
  if (state_ == State::kSynced && number == kOpenSession) return open_session(now);
  if (number >= kSyncSteps) return;  // before the session nothing else has a meaning
  if (number == 0) sync_index_ = 0;
  if (state_ == State::kSynced && number == 2) sync_index_ = 2;  // repeated after a lost reply
  if (number != sync_index_) {
    sync_index_ = 0;
    state_ = State::kWait;
    output_.push(arcos::PacketBuilder(kWrongSync).frame(), now);
    return;
  }
  arcos::PacketBuilder echo(number);
  if (number == 2) echo.text(parameters_.robot_name).text("Pioneer").text(parameters_.subclass);
  output_.push(echo.frame(), now);
  ++sync_index_;
  state_ = sync_index_ == kSyncSteps ? State::kSynced : State::kWait;
}

void ArcosDevice::handle_open(const arcos::Command& command, SimTime now) {
  switch (command.number) {
    case kPulse:
    case kOpenSession:
      return;
    case kClose:
      return close_session();
    case kEnable:
      return enable_motors(command.value != 0);
    case kSetOrigin:
      drive_.origin_set(reckoning());
      x_mm_ = y_mm_ = heading_rad_ = 0.0;
      return;
    case kSonar:
      return switch_sonar(command.value);
    case kDigout:
      digout_ = (digout_ & ~(command.value >> 8)) | (command.value & command.value >> 8 & 0xFF);
      return;
    case kBumpStall:
      bump_stall_mode_ = command.value;
      return;
    case kEStall:
      e_stall_ = command.value != 0;
      return;
    case kBatteryTest:
      parameters_.battery_volts = command.value > 0 ? command.value / 10.0 : 12.7;
      return;
    case kReset:
      return controller_reset(now);
    default:
      handle_motion(command);
      handle_request(command, now);
  }
}

void ArcosDevice::handle_motion(const arcos::Command& command) {
  switch (command.number) {
    case kSetA:
      return drive_.set_acceleration(command.value);
    case kSetV:
      return drive_.set_max_velocity(command.value);
    case kSetRv:
      return drive_.set_max_rotation(command.value);
    case kSetRa:
      return drive_.set_rotation_acceleration(command.value);
    case kMove:
      return drive_.move(std::clamp(command.value, -kMoveMost_mm, kMoveMost_mm), reckoning());
    case kHead:
      return drive_.turn_to(command.value);
    case kDhead:
      return drive_.turn_by(command.value, reckoning());
    case kDchead:
      return drive_.turn_on(command.value, reckoning());
    case kVel:
      return drive_.set_velocity(command.value);
    case kRotate:
    case kRvel:
      return drive_.set_rotation(command.value);
    case kVel2:
      return drive_.set_wheels(signed_byte(command.value, 8), signed_byte(command.value, 0));
    case kStop:
      return drive_.stop();
    case kEStop:
    case kQStop:
      return drive_.emergency_stop();
    default:
      return;  // unknown commands are ignored
  }
}

void ArcosDevice::handle_request(const arcos::Command& command, SimTime now) {
  switch (command.number) {
    case kConfig:
      output_.push(arcos::config_packet(parameters_, baud_code_), now);
      return;
    case kEncoder:
      encoder_stream_ = command.value;
      return;
    case kIoRequest:
      io_stream_ = command.value;
      return;
    case kGyro:
      gyro_stream_ = parameters_.has_gyro && command.value != 0;
      return;
    case kHostBaud:
      return set_baud(command.value);
    default:
      return;
  }
}

void ArcosDevice::switch_sonar(int value) {
  constexpr unsigned kBothArrays = 3;
  const auto bits = static_cast<unsigned>(value);
  const unsigned array = bits >> 1U & 0xFU;  // bits 1 to 4 select one array, bit 0 switches it
  const unsigned mask = array == 0 ? kBothArrays : (1U << (array - 1U)) & kBothArrays;
  sonar_arrays_ = (bits & 1U) != 0 ? sonar_arrays_ | mask : sonar_arrays_ & ~mask;
}

void ArcosDevice::set_baud(int code) {
  if (arcos::baud_of_code(code) != 0) baud_code_ = code;
}

}  // namespace topo::sim

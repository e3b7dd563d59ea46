// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/drivers/pioneer/scripted_robot.hpp"

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using types::Duration;
using types::Stamp;

class ScriptedStream final : public io::ByteStream {
 public:
  explicit ScriptedStream(ScriptedRobot& robot) : robot_(robot) {}
  types::Result<io::ReadResult> read(std::span<std::byte> buffer, Duration timeout) override {
    return robot_.read(buffer, timeout);
  }
  types::Status write(std::span<const std::byte> bytes, Duration) override { return robot_.write(bytes); }
  types::Status set_baud(int baud) override {
    robot_.baud_of_host = baud;
    return {};
  }
  [[nodiscard]] bool has_baud() const override { return robot_.has_baud; }
  [[nodiscard]] Stamp now() const override { return robot_.now; }

 private:
  ScriptedRobot& robot_;
};

unsigned value(std::byte b) { return std::to_integer<unsigned>(b); }

unsigned wire_sum(std::span<const std::byte> payload) {
  unsigned sum = 0;
  for (std::size_t i = 0; i + 1 < payload.size(); i += 2)
    sum = (sum + value(payload[i]) * 256 + value(payload[i + 1])) % 65536;
  return payload.size() % 2 == 1 ? sum ^ value(payload.back()) : sum;
}

}  // namespace

types::Result<std::unique_ptr<io::ByteStream>> ScriptedConnector::connect(Duration) {
  if (!robot_.port_exists) return types::fail(types::Errc::kNotFound, "/dev/scripted: no such device");
  ++robot_.opened_ports;
  robot_.cut = false;
  robot_.connected();
  return std::unique_ptr<io::ByteStream>(std::make_unique<ScriptedStream>(robot_));
}

void ScriptedRobot::connected() {
  confused_ = false;
  if (simulator == Simulator::kNone) return;
  sync_ = 0;
  open = false;
}

ScriptedRobot::ScriptedRobot() { received.reserve(100000); }

void ScriptedRobot::forget() {
  received.clear();
  largest_motion_mmps = 0;
}

std::vector<int> ScriptedRobot::commands() const {
  std::vector<int> out;
  for (const Received& r : received) out.push_back(r.command);
  return out;
}

int ScriptedRobot::count(int command) const {
  return static_cast<int>(std::count_if(received.begin(), received.end(),
                                        [&](const Received& r) { return r.command == command; }));
}

const Received* ScriptedRobot::last(int command) const {
  const auto found = std::find_if(received.rbegin(), received.rend(),
                                  [&](const Received& r) { return r.command == command; });
  return found == received.rend() ? nullptr : &*found;
}

void ScriptedRobot::send_raw(const Bytes& bytes) {
  const std::size_t size = std::min(bytes.size(), out_.size() - out_size_);
  std::copy_n(bytes.begin(), size, out_.begin() + static_cast<std::ptrdiff_t>(out_size_));
  out_size_ += size;
}

void ScriptedRobot::send(const Bytes& payload) {
  const unsigned sum = wire_sum(payload);
  const auto put = [&](unsigned v) { out_[out_size_++] = static_cast<std::byte>(v); };
  if (out_size_ + payload.size() + 5 > out_.size()) return;  // nobody reads
  put(0xFA);
  put(0xFB);
  put(static_cast<unsigned>(payload.size()) + 2);
  for (const std::byte b : payload) put(value(b));
  put(sum / 256);
  put(sum % 256);
}

types::Result<io::ReadResult> ScriptedRobot::read(std::span<std::byte> buffer, Duration timeout) {
  const Stamp end = now + timeout;
  while (out_size_ == 0 && now < end && !cut) advance(std::min<Duration>(milliseconds(1), end - now));
  if (cut) return types::fail(types::Errc::kClosed, "unplugged");
  const std::size_t size = std::min(buffer.size(), out_size_);
  std::copy_n(out_.begin(), size, buffer.begin());
  std::copy(out_.begin() + static_cast<std::ptrdiff_t>(size),
            out_.begin() + static_cast<std::ptrdiff_t>(out_size_), out_.begin());
  out_size_ -= size;
  return io::ReadResult{size, now};
}

types::Status ScriptedRobot::write(std::span<const std::byte> bytes) {
  if (cut) return types::fail(types::Errc::kClosed, "unplugged");
  if (!powered) return {};
  if (!chatter.empty()) send_raw(to_bytes(std::as_bytes(std::span(chatter))));
  if (echoes) send_raw(to_bytes(bytes));
  if (!chatter.empty() || echoes || (has_baud && baud_of_host != baud)) return {};
  for (const std::byte b : bytes) {
    in_[in_size_++] = b;
    if (in_size_ == 1 && value(b) != 0xFA) in_size_ = 0;
    if (in_size_ < 3 || in_size_ < value(in_[2]) + 3) continue;
    const auto payload = std::span<const std::byte>(in_).subspan(3, value(in_[2]) - 2);
    if (wire_sum(payload) == value(in_[in_size_ - 2]) * 256 + value(in_[in_size_ - 1])) on_packet(payload);
    in_size_ = 0;
  }
  return {};
}

void ScriptedRobot::on_packet(std::span<const std::byte> payload) {
  const int command = static_cast<int>(value(payload[0]));
  const bool has_argument = payload.size() >= 4;
  int argument = has_argument ? static_cast<int>(value(payload[2]) + value(payload[3]) * 256) : 0;
  if (has_argument && payload[1] == std::byte{0x1B}) argument = -argument;
  if (loses && loses(command)) return;
  received.push_back({command, has_argument, argument, now, baud_of_host});
  last_packet_ = now;
  asleep_ = false;
  if (open)
    on_command(command, argument);
  else
    on_handshake(command, has_argument);
  if (!asleep_ && motors) {  // whatever the packet was: the setpoints live again
    velocity_mmps = setpoint_mmps;
    rotation_degps = setpoint_degps;
  }
  largest_motion_mmps = std::max(largest_motion_mmps, std::abs(velocity_mmps));
}

void ScriptedRobot::on_handshake(int command, bool has_argument) {
  if (confused_) return;
  if (simulator != Simulator::kNone && command != sync_ && sync_ < 3) {
    confused_ = true;
    cut = simulator == Simulator::kCloses;
    if (!cut) send({static_cast<std::byte>(command)});
    return;
  }
  if (command == 2 && has_argument) sync_ = 0;  // a CLOSE, not SYNC2
  if (command > 2 || has_argument) return;
  if (sync_ < 3 && command != sync_) {
    sync_ = 0;
    return send({std::byte{0xFF}});
  }
  if (command < 2 && sync_ < 3) send({static_cast<std::byte>(command)});
  if (command == 2) {
    const std::string names = name + '\0' + robot_class + '\0' + subclass + '\0';
    send(Bytes{std::byte{2}} + to_bytes(std::as_bytes(std::span(names))));
  }
  ++sync_;
}

void ScriptedRobot::on_command(int command, int argument) {
  if (command == 2 && !deaf_to_close) {
    open = motors = false;
    sync_ = 0;
    velocity_mmps = setpoint_mmps = rotation_degps = setpoint_degps = 0;
  }
  if (command == 4) motors = argument != 0;
  if (command == 11) setpoint_mmps = argument;
  if (command == 21) setpoint_degps = argument;
  if (command == 55 || command == 29) setpoint_mmps = setpoint_degps = 0;
  if (command == 18 && answers_config) send_config();
  if (command == 19 && answers_encoder) encoder_due_ = now + encoder_delay;
  if (!motors) velocity_mmps = rotation_degps = 0;
}

void ScriptedRobot::send_config() {
  Bytes payload = config_payload(config);
  if (cuts_config) payload.resize(20);
  send(payload);
  if (damages_config) out_[out_size_ - 1] ^= std::byte{1};
}

void ScriptedRobot::advance(Duration duration) {
  const Stamp end = now + duration;
  while (now < end) {
    now = std::min(end, now + milliseconds(1));
    tick();
  }
}

void ScriptedRobot::tick() {
  if (encoder_due_ && now >= *encoder_due_) {
    encoder_due_.reset();
    send(Bytes(9, std::byte{0x90}));
  }
  if (sync_ == 3 && !open && !received.empty() && received.back().command == 1 &&
      received.back().has_argument) {
    open = true;
    next_status_ = now + milliseconds(100);
  }
  x_mm += velocity_mmps * 0.001;
  if (open && config.watchdog_ms > 0 && now - last_packet_ > milliseconds(config.watchdog_ms)) {
    asleep_ = true;  // the setpoints stay
    velocity_mmps = rotation_degps = 0;
  }
  if (!open || !powered || !sends_status || now < next_status_) return;
  next_status_ = now + milliseconds(config.sip_cycle_ms);
  if (!has_baud || baud == baud_of_host) send_status();
}

void ScriptedRobot::send_status() {
  static thread_local Bytes payload;
  payload.clear();
  const auto u8 = [&](unsigned v) { payload.push_back(static_cast<std::byte>(v & 0xFFU)); };
  const auto u16 = [&](int v) {
    u8(static_cast<unsigned>(v));
    u8(static_cast<unsigned>(v) >> 8U);
  };
  u8(velocity_mmps == 0 ? 0x32 : 0x33);
  u16(static_cast<int>(std::floor(x_mm)) & 0x7FFF);
  u16(0);
  u16(heading_units);
  constexpr double kHalfTrack_mm = 1.0 / 0.0056;
  const int turn_mmps = static_cast<int>(std::lround(rotation_degps * types::kDegree_rad * kHalfTrack_mm));
  u16(velocity_mmps - turn_mmps);
  u16(velocity_mmps + turn_mmps);
  u8(127);
  u16(static_cast<int>(stall_bump));
  u16(0);
  u16(static_cast<int>(flags | (motors ? 1U : 0U)));
  u8(0);
  u8(1);
  u8(2);
  u16(1234);
  send(payload);
}

}  // namespace topo::pioneer

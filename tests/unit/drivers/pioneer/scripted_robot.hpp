// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/io/byte_stream.hpp"
#include "tests/unit/drivers/pioneer/config_payload.hpp"
#include "tests/unit/drivers/pioneer/hex.hpp"

namespace topo::pioneer {

/// A command as it arrived, with its sign applied.
struct Received {
  int command = 0;
  bool has_argument = false;
  int argument = 0;
  types::Stamp stamp{};
  int baud = 0;
};

/// A Pioneer in the test's process on a clock that only reads and pauses advance. Written from PROTOCOLS
/// sections 1 to 5 and 8, with framing of its own; storage is reserved so that it does not allocate either.
class ScriptedRobot {
 public:
  ScriptedRobot();

  // What a test sets.
  std::string robot_class = "Pioneer", subclass = "p3dx-sh", name = "scripted";  ///< in SYNC2
  ConfigValues config;
  bool answers_config = true;
  bool damages_config = false;   ///< its checksum is wrong, every time
  bool cuts_config = false;      ///< its checksum is right, and it ends within the robot's name
  bool answers_encoder = false;  ///< ENCODER by an ENCODERpac, after encoder_delay
  types::Duration encoder_delay{};
  bool powered = true;  ///< off: silence
  bool sends_status = true;
  bool port_exists = true;
  bool cut = false;  ///< reads and writes fail: unplugged
  bool has_baud = false;
  int baud = 9600;      ///< of the robot's line
  bool open = false;    ///< of the connection: true at the start is a stale one
  bool echoes = false;  ///< a loop-back plug
  std::string chatter;  ///< sent on every write instead of ARCOS: another device
  bool deaf_to_close = false;
  std::string port = "/dev/scripted";
  /// A simulator that takes every number before the connection for a SYNC.
  enum class Simulator { kNone, kEchoes, kCloses };
  Simulator simulator = Simulator::kNone;
  std::function<bool(int command)> loses;  ///< on the line, before the robot hears it
  unsigned flags = 0;                      ///< besides the motors' bit
  unsigned stall_bump = 0;

  // What it does.
  types::Stamp now{std::chrono::seconds(100)};
  std::vector<Received> received;
  int velocity_mmps = 0, rotation_degps = 0;  ///< that the wheels do
  int setpoint_mmps = 0, setpoint_degps = 0;  ///< remembered, resumed on any packet
  int largest_motion_mmps = 0;                ///< since the test cleared it
  double x_mm = 0.0;
  int heading_units = 0;
  bool motors = false;
  int opened_ports = 0;
  int baud_of_host = 0;

  void send(const Bytes& payload);  ///< framed
  void send_raw(const Bytes& bytes);
  void forget();  ///< what was received
  [[nodiscard]] std::vector<int> commands() const;
  [[nodiscard]] int count(int command) const;
  [[nodiscard]] const Received* last(int command) const;

  // The stream's side.
  void connected();
  types::Result<io::ReadResult> read(std::span<std::byte> buffer, types::Duration timeout);
  types::Status write(std::span<const std::byte> bytes);
  void advance(types::Duration duration);

 private:
  void on_packet(std::span<const std::byte> payload);
  void on_handshake(int command, bool has_argument);
  void on_command(int command, int argument);
  void tick();
  void send_status();
  void send_config();

  int sync_ = 0;
  bool confused_ = false;  ///< a simulator whose count of SYNCs is beyond the last
  bool asleep_ = true;     ///< no packet for a watchdog's time
  types::Stamp last_packet_{};
  types::Stamp next_status_{};
  std::optional<types::Stamp> encoder_due_;
  std::array<std::byte, 8192> out_{};  ///< to the host
  std::size_t out_size_ = 0;
  std::array<std::byte, 512> in_{};
  std::size_t in_size_ = 0;
};

class ScriptedConnector final : public io::Connector {
 public:
  explicit ScriptedConnector(ScriptedRobot& robot) : robot_(robot) {}
  types::Result<std::unique_ptr<io::ByteStream>> connect(types::Duration timeout) override;
  [[nodiscard]] std::string_view name() const override { return robot_.port; }
  [[nodiscard]] types::Stamp now() const override { return robot_.now; }
  void pause(types::Duration duration) override { robot_.advance(duration); }

 private:
  ScriptedRobot& robot_;
};

}  // namespace topo::pioneer

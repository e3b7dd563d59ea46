// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "tests/sim/devices/arcos_drive.hpp"
#include "tests/sim/devices/arcos_gyro.hpp"
#include "tests/sim/devices/arcos_model.hpp"
#include "tests/sim/devices/arcos_packet.hpp"
#include "tests/sim/devices/arcos_sip.hpp"
#include "tests/sim/devices/base_faults.hpp"
#include "tests/sim/devices/wire_device.hpp"

namespace topo::sim {

/// The controller's inputs from wheels and bumpers.
struct BaseInputs {
  double left_m = 0.0;  ///< travel of the wheel by its encoder, from any origin
  double right_m = 0.0;
  double left_mps = 0.0;
  double right_mps = 0.0;
  bool left_stall = false;
  bool right_stall = false;
  std::uint8_t front_bumpers = 0;  ///< bit i is segment i + 1
  std::uint8_t rear_bumpers = 0;
  double omega_radps = 0.0;  ///< true turning speed, which a gyro feels
};

/// A Pioneer's firmware without its wire: receives commands, sends SIPs, returns wheel speeds for the motors
/// (PROTOCOLS sections 1 to 8). Not thread-safe; the output does not depend on how the received bytes are
/// split.
class ArcosDevice final : public WireDevice {
 public:
  enum class State { kWait, kSynced, kOpen };

  ArcosDevice(arcos::Parameters parameters, std::uint64_t seed);

  void receive(std::span<const std::uint8_t> bytes, SimTime now) override;
  void tick(SimTime now) override;
  void client_gone(SimTime /*now*/) override {}  // the session outlives its client (PROTOCOLS section 2)
  void power_cycle(SimTime now) override;
  std::optional<SimTime> take_absence(SimTime /*now*/) override { return std::nullopt; }
  [[nodiscard]] unsigned line_rate_bps() const override { return arcos::baud_of_code(baud_code_); }
  [[nodiscard]] OutputQueue& output() override { return output_; }

  /// One cycle of the motor loop (1 to 5 ms): reads the encoders, returns the target wheel speeds.
  arcos::WheelTargets control(SimTime now, SimTime dt, const BaseInputs& inputs);
  /// Takes an echo of a transducer into the next SIP when its array is on.
  void add_sonar(int index, double range_m);

  void set_stop_button(bool pressed);
  /// Presses bumper segments (masks as in BaseInputs) until a given time, in addition to contacts of the
  /// body.
  void press_bumpers(std::uint8_t front, std::uint8_t rear, SimTime until);
  /// The voltage from now on, and its fall, V/s.
  void set_battery(double volts, double fall_vps, SimTime now);
  /// The button on the deck that switches the motors off; the host may switch them on again.
  void press_motors_button() { enable_motors(false); }
  /// Another controller by its name and serial number, as the host hears with the next connection.
  void set_identity(std::string robot_name, std::string serial);
  /// The firmware's watchdog from now on; the host hears it with the next connection.
  void set_watchdog(int ms) { parameters_.watchdog_ms = ms; }
  [[nodiscard]] BaseFaults& faults() { return faults_; }
  /// The controller restarts by itself: sends 0xFF, and returns to WAIT.
  void controller_reset(SimTime now);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] bool motors_on() const { return motors_on_; }
  [[nodiscard]] bool watchdog_holds(SimTime now) const;
  [[nodiscard]] const arcos::Parameters& parameters() const { return parameters_; }
  [[nodiscard]] std::uint64_t bad_packets() const { return receiver_.bad_checksums(); }
  /// E_STOP packets since the start, in any state.
  [[nodiscard]] std::uint64_t e_stops() const { return e_stops_; }
  /// Bytes since the start, of whatever kind.
  [[nodiscard]] std::uint64_t bytes_heard() const { return bytes_heard_; }

 private:
  void handle(const arcos::Command& command, SimTime now);
  void handle_sync(const arcos::Command& command, SimTime now);
  void handle_open(const arcos::Command& command, SimTime now);
  void handle_motion(const arcos::Command& command);
  void handle_request(const arcos::Command& command, SimTime now);
  void open_session(SimTime now);
  void close_session();
  void enable_motors(bool on);
  void switch_sonar(int value);
  void set_baud(int code);
  void bump_stall();

  void dead_reckon(const BaseInputs& inputs);
  [[nodiscard]] arcos::Reckoning reckoning() const;
  void send_sip(SimTime now);
  [[nodiscard]] arcos::Sip compose_sip(SimTime now);
  [[nodiscard]] int stall_bump_bits() const;
  [[nodiscard]] int flag_bits() const;

  arcos::Parameters parameters_;
  arcos::Drive drive_;
  arcos::Receiver receiver_;
  OutputQueue output_;
  std::mt19937_64 random_;

  State state_ = State::kWait;
  int sync_index_ = 0;
  int baud_code_;
  SimTime last_packet_{0};
  std::uint64_t e_stops_ = 0;
  std::uint64_t bytes_heard_ = 0;
  SimTime next_sip_{0};

  bool motors_on_ = false;
  bool stop_button_ = false;
  bool stall_by_button_ = false;  ///< FLAGS bit 6
  bool e_stall_ = true;
  int bump_stall_mode_ = 0;
  bool bump_stalled_ = false;
  unsigned sonar_arrays_ = 0;  ///< bit 0 front, bit 1 rear
  int digout_ = 0;
  int encoder_stream_ = 0;  ///< 0 off, 1 once, 2 continuously
  int io_stream_ = 0;
  bool gyro_stream_ = false;
  arcos::AnalogGyro gyro_;

  [[nodiscard]] bool swallows(const arcos::Command& command);
  [[nodiscard]] BaseInputs faulty(BaseInputs inputs, SimTime now);

  BaseFaults faults_;
  std::uint64_t sips_ = 0;
  BaseInputs inputs_;
  bool have_ticks_ = false;
  std::int64_t left_ticks_ = 0;
  std::int64_t right_ticks_ = 0;
  double way_mm_ = 0.0;
  double x_mm_ = 0.0;
  double y_mm_ = 0.0;
  double heading_rad_ = 0.0;
  std::vector<arcos::SonarReading> sonar_;
  std::uint8_t pressed_front_ = 0;
  std::uint8_t pressed_rear_ = 0;
  SimTime pressed_until_{0};
};

}  // namespace topo::sim

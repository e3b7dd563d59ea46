// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tests/sim/devices/device_clock.hpp"
#include "tests/sim/devices/scan_faults.hpp"
#include "tests/sim/devices/scip_models.hpp"
#include "tests/sim/devices/scip_scan.hpp"
#include "tests/sim/devices/scip_text.hpp"
#include "tests/sim/devices/scip_turn.hpp"
#include "tests/sim/devices/wire_device.hpp"

namespace topo::sim {

struct ScipOptions {
  ScipModel model = ScipModel::kUtm30LxEw;
  std::string serial = "H0123456";
  double clock_offset_ms = 0.0;  ///< the counter at the simulation's start
  double clock_drift_ppm = 0.0;  ///< deviation of its rate from the simulation's time
  int scans_behind_quit = 1;     ///< scans that still leave before the reply to QT (PROTOCOLS 10.1)
};

enum class ScipHealth {
  kGood,
  kFault,   ///< answers, but does not measure, and reports that in its status and STAT
  kSilent,  ///< does not answer
};

/// A Hokuyo sensor without its wire: receives requests, sends replies and scans (PROTOCOLS sections 9 to 13).
/// Not thread-safe; the output does not depend on how the received bytes are split.
class ScipDevice final : public WireDevice {
 public:
  explicit ScipDevice(ScipOptions options);

  void receive(std::span<const std::uint8_t> bytes, SimTime now) override;
  void tick(SimTime now) override;
  void client_gone(SimTime now) override;
  void power_cycle(SimTime now) override;
  std::optional<SimTime> take_absence(SimTime now) override;
  [[nodiscard]] unsigned line_rate_bps() const override { return 0; }
  [[nodiscard]] OutputQueue& output() override { return output_; }

  /// Takes a complete turn: its data leave shortly after its end.
  void deliver(const scip::Turn& turn, SimTime now);

  [[nodiscard]] bool laser_on() const { return laser_on_ && health_ == ScipHealth::kGood; }
  [[nodiscard]] bool streaming() const { return streaming_; }
  [[nodiscard]] const ScipModelSpec& model() const { return model_; }
  [[nodiscard]] std::uint32_t clock_ms(SimTime now) const { return clock_.ticks_ms(now); }

  void set_health(ScipHealth health, SimTime now);
  void jump_clock(double ms) { clock_.jump(ms); }
  [[nodiscard]] const std::string& serial() const { return options_.serial; }
  /// Another sensor by its serial number, as the host hears when it asks.
  void set_serial(std::string serial) { options_.serial = std::move(serial); }
  [[nodiscard]] ScanFaults& faults() { return faults_; }
  /// Address, netmask and gateway in twelve digits each, as taken by $IP and in effect since a power cycle;
  /// empty: the factory's.
  [[nodiscard]] const std::string& network() const { return network_.in_effect; }
  /// Sends other steps from the next scan on, as if another host had asked for them, until the next request.
  /// False when it does not stream, or has no such steps.
  bool change_steps(int start, int end);

 private:
  using Handler = void (ScipDevice::*)(const scip::Request&, SimTime);
  struct Command;
  enum class Waiting { kNothing, kQuit, kSingleScan };

  void process_lines(SimTime now);
  void handle_line(std::string_view line, SimTime now);
  void dispatch(const scip::Request& request, SimTime now);
  [[nodiscard]] static std::span<const Command> commands();
  [[nodiscard]] bool offers(const Command& command) const;

  void version(const scip::Request& request, SimTime now);
  void parameters(const scip::Request& request, SimTime now);
  void information(const scip::Request& request, SimTime now);
  void laser_switch_on(const scip::Request& request, SimTime now);
  void quit(const scip::Request& request, SimTime now);
  void reset_all(const scip::Request& request, SimTime now);
  void reset_but_motor(const scip::Request& request, SimTime now);
  void reboot(const scip::Request& request, SimTime now);
  void time_mode(const scip::Request& request, SimTime now);
  void bit_rate(const scip::Request& request, SimTime now);
  void motor_speed(const scip::Request& request, SimTime now);
  void sensitivity(const scip::Request& request, SimTime now);
  void single_scan(const scip::Request& request, SimTime now);
  void stream(const scip::Request& request, SimTime now);
  void state_number(const scip::Request& request, SimTime now);
  void wedge(const scip::Request& request, SimTime now);
  void set_address(const scip::Request& request, SimTime now);

  void reply(std::string_view echo, std::string_view status, SimTime now);
  void reply_lines(const scip::Request& request, std::string lines, SimTime now);
  [[nodiscard]] std::string_view mesm() const;
  void send_stream_scan(const scip::Turn& turn, SimTime due);
  void answer_single_scan(const scip::Turn& turn, SimTime due);
  void finish_waiting(SimTime now);
  void to_idle();
  void stop_stream_with(std::string_view status, SimTime now);

  ScipOptions options_;
  const ScipModelSpec& model_;
  DeviceClock clock_;
  OutputQueue output_;

  std::string input_;
  bool discarding_line_ = false;
  Waiting waiting_ = Waiting::kNothing;
  std::string waiting_line_;
  int scans_to_wait_ = 0;
  SimTime waiting_until_{0};

  ScanFaults faults_;
  ScipHealth health_ = ScipHealth::kGood;
  bool scip11_ = false;
  bool wedged_ = false;
  bool laser_on_ = false;
  bool time_mode_ = false;
  bool sensitive_ = false;
  bool streaming_ = false;
  int bit_rate_bps_ = 19200;
  scip::ScanRequest request_;
  std::string request_line_;
  int sent_ = 0;
  int skip_ = 0;
  std::optional<scip::Turn> latest_;
  struct Network {
    std::string in_effect, next;
  };
  Network network_;
  std::optional<SimTime> reboot_asked_;
  std::optional<SimTime> reboot_at_;
};

}  // namespace topo::sim

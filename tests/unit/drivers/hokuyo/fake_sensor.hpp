// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/hokuyo/scip_codec.hpp"
#include "tests/mocks/scripted_stream.hpp"
#include "tests/unit/drivers/hokuyo/sensor_samples.hpp"

namespace topo::hokuyo::testing_scip {

/// A sensor of PROTOCOLS section 11 at the far end of a scripted line, with knobs for everything that goes
/// wrong. Its mirror turns on the line's clock.
class FakeSensor {
 public:
  FakeSensor(mocks::ScriptedLine& line, const Sample& sample);

  // Identity and state
  std::string vv, pp, ii;
  bool scip1 = false;   ///< as a URG-04LX at power-up
  bool adjust = false;  ///< left in adjust mode
  int baud = 0;         ///< the only line speed it understands; 0: any
  // Faults
  bool mute = false;          ///< answers nothing, sends nothing
  bool mute_scans = false;    ///< answers, but sends no scan
  std::string mute_commands;  ///< space-separated names it does not answer
  int laser_failures = 0;     ///< BM refused so many times (-1: for ever)
  bool frozen = false;        ///< the counter stands still
  int corrupt_scans = 0;      ///< the next scans get a wrong byte each
  int swallow_scans = 0;      ///< the next scans are measured, but not sent
  std::string inject_status;  ///< sent once instead of a scan; ends the stream from 50 on
  std::string adjust_status = "00";
  // Time
  types::Duration out = std::chrono::microseconds(200), back = std::chrono::microseconds(200);
  types::Duration latency = std::chrono::microseconds(500);  ///< behind the last step
  double counter_start_ms = 5000.0;
  double drift_ppm = 0.0;

  // What happened
  std::vector<std::string> heard;      ///< every request
  std::vector<types::Stamp> measured;  ///< when step 0 of every scan was measured
  bool laser = false;
  bool streaming = false;
  int resets = 0, reboots = 0;

  [[nodiscard]] int count(std::string_view command) const;
  [[nodiscard]] static std::uint32_t range_mm(std::size_t step) {
    return 1000 + static_cast<std::uint32_t>(step) % 4000;
  }
  void power_cycle();

 private:
  void on_write(std::string_view bytes);
  void on_request(const std::string& request);
  void on_adjust_request(const std::string& request);
  void on_wait(types::Stamp until);
  void start_stream(const std::string& request);
  void send_scan(types::Stamp begin);
  void answer(const std::string& echo, const std::string& status, const std::string& lines = "");
  [[nodiscard]] std::uint32_t counter(types::Stamp t) const;

  mocks::ScriptedLine& line_;
  const Sample& sample_;
  std::string partial_;
  StreamRequest stream_;
  std::string stream_echo_;
  types::Stamp next_scan_{};
  types::Stamp counter_zero_{};
  types::Stamp last_reboot_request_{};
};

}  // namespace topo::hokuyo::testing_scip

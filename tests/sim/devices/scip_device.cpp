// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/scip_device.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "tests/sim/devices/scip_text.hpp"

namespace topo::sim {
namespace {

constexpr std::size_t kLongestLine = 128;
constexpr std::size_t kInputLimit = 4096;
constexpr std::size_t kScanOutputLimit =
    std::size_t{256} * 1024;  // about 40 ME scans: more means a client that does not read
constexpr SimTime kSendTick =
    std::chrono::milliseconds{1};                   // data leave at the next 1 ms tick (PROTOCOLS 12)
constexpr std::string_view kHardwareStatus = "70";  // within 50..97: hardware trouble

}  // namespace

ScipDevice::ScipDevice(ScipOptions options)
    : options_(std::move(options)),
      model_(scip_model(options_.model)),
      clock_(options_.clock_offset_ms, options_.clock_drift_ppm),
      output_(kScanOutputLimit),
      scip11_(model_.boots_in_scip11) {}

void ScipDevice::receive(std::span<const std::uint8_t> bytes, SimTime now) {
  if (health_ == ScipHealth::kSilent || wedged_) return;
  for (const std::uint8_t byte : bytes) {
    if (input_.size() < kInputLimit) input_.push_back(static_cast<char>(byte));
  }
  process_lines(now);
}

void ScipDevice::process_lines(SimTime now) {
  while (waiting_ == Waiting::kNothing && !wedged_) {
    const auto end = input_.find_first_of("\r\n");
    if (end == std::string::npos) {
      // A line longer than any request is garbage: its end must not count as a request.
      if (input_.size() > kLongestLine) {
        discarding_line_ = true;
        input_.clear();
      }
      return;
    }
    const std::string line = input_.substr(0, end);
    input_.erase(0, end + 1);
    const bool garbage = std::exchange(discarding_line_, false) || line.size() > kLongestLine;
    if (!garbage && !line.empty()) handle_line(line, now);
  }
}

void ScipDevice::handle_line(std::string_view line, SimTime now) {
  if (scip11_) {
    const bool upgrade = line == "SCIP2.0";
    if (upgrade) scip11_ = false;
    output_.push(std::string(line) + (upgrade ? "\n0\n\n" : "\nE\n\n"), now);
    return;
  }
  const scip::Request request = scip::split_request(line);
  if (const auto fault = scip::string_fault(request); !fault.empty()) return reply(line, fault, now);
  dispatch(request, now);
}

void ScipDevice::tick(SimTime now) {
  if (waiting_ != Waiting::kNothing && now >= waiting_until_) {
    finish_waiting(now);
    process_lines(now);
  }
}

void ScipDevice::client_gone(SimTime now) {
  input_.clear();
  output_.clear();
  discarding_line_ = false;
  waiting_ = Waiting::kNothing;
  time_mode_ = false;
  to_idle();
  tick(now);
}

void ScipDevice::power_cycle(SimTime now) {
  client_gone(now);
  clock_.reset(now);
  network_.in_effect = network_.next;
  health_ = ScipHealth::kGood;
  wedged_ = false;
  sensitive_ = false;
  bit_rate_bps_ = 19200;
  scip11_ = model_.boots_in_scip11;
  reboot_asked_.reset();
  reboot_at_.reset();
}

std::optional<SimTime> ScipDevice::take_absence(SimTime now) {
  constexpr SimTime kBootTime = std::chrono::seconds{2};
  if (!reboot_at_ || now < *reboot_at_) return std::nullopt;
  power_cycle(now);
  return kBootTime;
}

void ScipDevice::set_health(ScipHealth health, SimTime now) {
  health_ = health;
  if (health == ScipHealth::kGood) return;
  if (health == ScipHealth::kFault) stop_stream_with(kHardwareStatus, now);
  to_idle();
  if (health == ScipHealth::kSilent) output_.clear();
}

void ScipDevice::stop_stream_with(std::string_view status, SimTime now) {
  if (!streaming_) return;
  reply(scip::stream_echo(request_line_, 0), status, now);
  streaming_ = false;
}

void ScipDevice::to_idle() {
  laser_on_ = false;
  streaming_ = false;
  latest_.reset();
}

void ScipDevice::reply(std::string_view echo, std::string_view status, SimTime now) {
  output_.push(scip::status_reply(echo, status), now);
}

bool ScipDevice::change_steps(int start, int end) {
  if (!streaming_ || start < model_.amin || end < start || end > model_.amax) return false;
  request_.start = start;
  request_.end = end;
  std::array<char, 16> digits{};
  std::snprintf(digits.data(), digits.size(), "%04d%04d", start, end);
  constexpr std::size_t kStepsAt = 2, kStepsSize = 8;  // MD SSSS EEEE CC I NN
  request_line_.replace(kStepsAt, kStepsSize, digits.data());
  return true;
}

void ScipDevice::deliver(const scip::Turn& measured, SimTime now) {
  if (!laser_on()) return;
  const scip::Turn turn = faults_.seen(measured, model_);
  const SimTime end = turn.step0 + model_.period() * model_.amax / model_.ares;
  const SimTime due = std::max(now, end + kSendTick);
  latest_ = turn;
  if (streaming_) send_stream_scan(turn, due);
  if (waiting_ == Waiting::kSingleScan) {
    answer_single_scan(turn, due);
    waiting_ = Waiting::kNothing;
    process_lines(now);
  } else if (waiting_ == Waiting::kQuit && --scans_to_wait_ <= 0) {
    finish_waiting(due);
    process_lines(now);
  }
}

void ScipDevice::send_stream_scan(const scip::Turn& turn, SimTime due) {
  if (skip_ > 0) {
    --skip_;
    return;
  }
  skip_ = request_.interval;
  ++sent_;
  const int remaining = request_.count == 0 ? 0 : request_.count - sent_;
  output_.push_droppable(
      scip::data_reply(scip::stream_echo(request_line_, remaining), "99", clock_.ticks_ms(turn.step0),
                       scip::encode_turn(request_, model_, turn)),
      due);
  if (request_.count != 0 && remaining == 0) {
    streaming_ = false;
    laser_on_ = false;
  }
}

void ScipDevice::answer_single_scan(const scip::Turn& turn, SimTime due) {
  const scip::Request request = scip::split_request(waiting_line_);
  scip::ScanRequest scan;
  if (!scip::parse_scan_request(request.body, model_, scan).empty()) return;
  output_.push(scip::data_reply(waiting_line_, "00", clock_.ticks_ms(turn.step0),
                                scip::encode_turn(scan, model_, turn)),
               due);
}

void ScipDevice::finish_waiting(SimTime now) {
  if (waiting_ == Waiting::kQuit) {
    to_idle();
    reply(waiting_line_, "00", now);
  } else {
    reply(waiting_line_, "10", now);  // no sweep arrived: the laser is off
  }
  waiting_ = Waiting::kNothing;
}

}  // namespace topo::sim

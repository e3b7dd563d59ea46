// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The commands of PROTOCOLS section 10, one handler each.
#include <algorithm>
#include <array>
#include <cstdio>

#include "tests/sim/devices/scip_device.hpp"
#include "tests/sim/devices/scip_text.hpp"

namespace topo::sim {

struct ScipDevice::Command {
  std::string_view name;
  std::size_t parameters;  ///< number of characters after the name
  Handler handler;
};

std::span<const ScipDevice::Command> ScipDevice::commands() {
  constexpr std::size_t kSingle = 10;   // SSSSEEEECC
  constexpr std::size_t kStream = 13;   // SSSSEEEECCINN
  constexpr std::size_t kNetwork = 36;  // address, netmask, gateway: twelve digits each
  static constexpr std::array kCommands{
      Command{"VV", 0, &ScipDevice::version},
      Command{"PP", 0, &ScipDevice::parameters},
      Command{"II", 0, &ScipDevice::information},
      Command{"BM", 0, &ScipDevice::laser_switch_on},
      Command{"QT", 0, &ScipDevice::quit},
      Command{"RS", 0, &ScipDevice::reset_all},
      Command{"RT", 0, &ScipDevice::reset_but_motor},
      Command{"RB", 0, &ScipDevice::reboot},
      Command{"TM", 1, &ScipDevice::time_mode},
      Command{"SS", 6, &ScipDevice::bit_rate},
      Command{"CR", 2, &ScipDevice::motor_speed},
      Command{"HS", 1, &ScipDevice::sensitivity},
      Command{"GD", kSingle, &ScipDevice::single_scan},
      Command{"GS", kSingle, &ScipDevice::single_scan},
      Command{"GE", kSingle, &ScipDevice::single_scan},
      Command{"HD", kSingle, &ScipDevice::single_scan},
      Command{"HE", kSingle, &ScipDevice::single_scan},
      Command{"MD", kStream, &ScipDevice::stream},
      Command{"MS", kStream, &ScipDevice::stream},
      Command{"ME", kStream, &ScipDevice::stream},
      Command{"ND", kStream, &ScipDevice::stream},
      Command{"NE", kStream, &ScipDevice::stream},
      Command{"%ST", 0, &ScipDevice::state_number},
      Command{"$IP", kNetwork, &ScipDevice::set_address},
  };
  return kCommands;
}

bool ScipDevice::offers(const Command& command) const {
  const std::string_view name = command.name;
  if (name == "RB") return model_.ethernet;
  if (name == "%ST" || name == "$IP") return model_.ethernet;
  if (name == "GS" || name == "MS") return model_.two_character;
  if (name == "GE" || name == "ME") return model_.intensity;
  if (name == "ND" || name == "NE" || name == "HD" || name == "HE") return model_.multi_echo;
  return true;
}

void ScipDevice::dispatch(const scip::Request& request, SimTime now) {
  for (const Command& command : commands()) {
    if (!request.body.starts_with(command.name)) continue;
    if (!offers(command)) {
      const bool scan = command.name[0] == 'M' || command.name[0] == 'N';
      if (scan && model_.wedges_on_unknown_scan) return wedge(request, now);
      break;
    }
    const std::size_t given = request.body.size() - command.name.size();
    if (given < command.parameters) return reply(request.line, "0C", now);
    if (given > command.parameters) return reply(request.line, "0D", now);
    return (this->*command.handler)(request, now);
  }
  reply(request.line, "0E", now);
}

void ScipDevice::reply_lines(const scip::Request& request, std::string lines, SimTime now) {
  std::string out;
  out.append(request.line).append("\n");
  scip::append_summed_line(out, "00");
  out.append(lines).append("\n");
  output_.push(std::move(out), now);
}

void ScipDevice::version(const scip::Request& request, SimTime now) {
  std::string lines;
  scip::append_key_line(lines, "VEND", model_.vendor, false);
  scip::append_key_line(lines, "PROD", model_.product, false);
  scip::append_key_line(lines, "FIRM", model_.firmware, false);
  scip::append_key_line(lines, "PROT", model_.protocol, false);
  scip::append_key_line(lines, "SERI", options_.serial, false);
  reply_lines(request, std::move(lines), now);
}

void ScipDevice::parameters(const scip::Request& request, SimTime now) {
  std::string lines;
  scip::append_key_line(lines, "MODL", model_.modl, false);
  const std::array<std::pair<std::string_view, int>, 7> numbers{{{"DMIN", model_.dmin_mm},
                                                                 {"DMAX", model_.dmax_mm},
                                                                 {"ARES", model_.ares},
                                                                 {"AMIN", model_.amin},
                                                                 {"AMAX", model_.amax},
                                                                 {"AFRT", model_.afrt},
                                                                 {"SCAN", model_.scan_rpm}}};
  for (const auto& [key, value] : numbers) scip::append_key_line(lines, key, std::to_string(value), false);
  reply_lines(request, std::move(lines), now);
}

std::string_view ScipDevice::mesm() const {
  if (health_ == ScipHealth::kFault) return model_.scip22 ? "900 Error_detected" : "ERROR";
  if (time_mode_) return model_.scip22 ? "002 Time_adjustment" : "TIME ADJUST";
  if (streaming_) return model_.mesm_multi;
  return laser_on_ ? model_.mesm_single : model_.mesm_idle;
}

void ScipDevice::information(const scip::Request& request, SimTime now) {
  std::string time;
  if (model_.time_is_scip) {
    scip::append_value(time, clock_.ticks_ms(now), 4);
  } else {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "%06X", clock_.ticks_ms(now));
    time = text.data();
  }
  const bool arrow = model_.sums_to_arrow;
  const bool good = health_ == ScipHealth::kGood;
  std::string lines;
  scip::append_key_line(lines, "MODL", model_.modl, arrow);
  scip::append_key_line(lines, "LASR", laser_on() ? "ON" : "OFF", arrow);
  scip::append_key_line(lines, "SCSP", model_.scan_speed, arrow);
  scip::append_key_line(lines, "MESM", mesm(), arrow);
  scip::append_key_line(lines, "SBPS", model_.bit_rate, arrow);
  scip::append_key_line(lines, "TIME", time, arrow);
  scip::append_key_line(lines, "STAT", good ? model_.stat_good : "Trouble!! Error No. =[00->33]", arrow);
  reply_lines(request, std::move(lines), now);
}

void ScipDevice::laser_switch_on(const scip::Request& request, SimTime now) {
  if (time_mode_) return reply(request.line, "10", now);
  if (health_ == ScipHealth::kFault) return reply(request.line, model_.scip22 ? "0L" : "01", now);
  const bool was_on = laser_on_;
  laser_on_ = true;
  reply(request.line, was_on ? "02" : "00", now);
}

void ScipDevice::quit(const scip::Request& request, SimTime now) {
  if (time_mode_) return reply(request.line, model_.scip22 ? "10" : "0E", now);
  if (health_ == ScipHealth::kFault) return reply(request.line, model_.scip22 ? "0L" : "00", now);
  if (!streaming_ || options_.scans_behind_quit == 0) {
    to_idle();
    return reply(request.line, "00", now);
  }
  // Scans already in progress leave before the reply.
  waiting_ = Waiting::kQuit;
  waiting_line_ = std::string(request.line);
  scans_to_wait_ = options_.scans_behind_quit;
  waiting_until_ = now + model_.period() * (2 * options_.scans_behind_quit);
}

void ScipDevice::reset_all(const scip::Request& request, SimTime now) {
  sensitive_ = false;
  bit_rate_bps_ = 19200;
  reset_but_motor(request, now);
}

void ScipDevice::reset_but_motor(const scip::Request& request, SimTime now) {
  to_idle();
  time_mode_ = false;
  clock_.reset(now);
  reply(request.line, "00", now);
}

void ScipDevice::reboot(const scip::Request& request, SimTime now) {
  constexpr SimTime kWithin = std::chrono::seconds{1};
  if (!reboot_asked_ || now - *reboot_asked_ > kWithin) {
    reboot_asked_ = now;
    return reply(request.line, "01", now);
  }
  reboot_asked_.reset();
  reboot_at_ = now + kWithin;
  reply(request.line, "00", now);
}

void ScipDevice::time_mode(const scip::Request& request, SimTime now) {
  const char control = request.body[2];
  if (control < '0' || control > '2') return reply(request.line, "01", now);
  if (streaming_) return reply(request.line, "10", now);
  if (control == '0') {
    const bool already = time_mode_;
    time_mode_ = true;
    laser_on_ = false;
    return reply(request.line, already ? "02" : "00", now);
  }
  if (control == '2') {
    const bool was = time_mode_;
    time_mode_ = false;
    return reply(request.line, was ? "00" : "03", now);
  }
  if (!time_mode_) return reply(request.line, "04", now);
  output_.push(scip::data_reply(request.line, "00", clock_.ticks_ms(now), {}), now);
}

void ScipDevice::bit_rate(const scip::Request& request, SimTime now) {
  if (!model_.serial_speeds) return reply(request.line, "04", now);
  const auto rate = scip::parse_digits(request.body.substr(2));
  if (!rate) return reply(request.line, "01", now);
  constexpr std::array kRates{19200, 38400, 57600, 115200, 250000, 500000, 750000};
  if (std::find(kRates.begin(), kRates.end(), *rate) == kRates.end()) return reply(request.line, "02", now);
  if (*rate == bit_rate_bps_) return reply(request.line, "03", now);
  bit_rate_bps_ = *rate;
  reply(request.line, "00", now);
}

void ScipDevice::motor_speed(const scip::Request& request, SimTime now) {
  if (!model_.serial_speeds) return reply(request.line, "04", now);
  const auto step = scip::parse_digits(request.body.substr(2));
  if (!step) return reply(request.line, "01", now);
  constexpr int kSlowest = 10;
  constexpr int kDefault = 99;
  // The mirror keeps its speed: a sensor that obeys CR would need a second PP (PROTOCOLS section 10).
  if (*step == 0 || *step == kDefault) return reply(request.line, "03", now);
  reply(request.line, *step <= kSlowest ? "04" : "02", now);
}

void ScipDevice::sensitivity(const scip::Request& request, SimTime now) {
  if (!model_.serial_speeds) return reply(request.line, "03", now);
  const char mode = request.body[2];
  if (mode != '0' && mode != '1') return reply(request.line, "01", now);
  const bool wanted = mode == '1';
  const bool same = wanted == sensitive_;
  sensitive_ = wanted;
  reply(request.line, same ? "02" : "00", now);
}

void ScipDevice::single_scan(const scip::Request& request, SimTime now) {
  scip::ScanRequest scan;
  if (const auto fault = scip::parse_scan_request(request.body, model_, scan); !fault.empty()) {
    return reply(request.line, fault, now);
  }
  if (health_ == ScipHealth::kFault) return reply(request.line, model_.scip22 ? "0L" : "70", now);
  if (time_mode_ || !laser_on_) return reply(request.line, "10", now);
  waiting_line_ = std::string(request.line);
  if (latest_) return answer_single_scan(*latest_, now);
  waiting_ = Waiting::kSingleScan;
  waiting_until_ = now + 4 * model_.period();
}

void ScipDevice::stream(const scip::Request& request, SimTime now) {
  scip::ScanRequest scan;
  if (const auto fault = scip::parse_scan_request(request.body, model_, scan); !fault.empty()) {
    return reply(request.line, fault, now);
  }
  if (time_mode_) return reply(request.line, "10", now);
  if (health_ == ScipHealth::kFault) return reply(request.line, model_.scip22 ? "0L" : "70", now);
  request_ = scan;
  request_line_ = std::string(request.line);
  sent_ = 0;
  skip_ = 0;
  laser_on_ = true;
  streaming_ = true;
  reply(request.line, "00", now);
}

void ScipDevice::state_number(const scip::Request& request, SimTime now) {
  std::string number(mesm().substr(0, 3));
  if (number.find_first_not_of("0123456789") != std::string::npos)
    number = streaming_ ? "004" : laser_on_ ? "003" : "000";
  std::string lines;
  scip::append_summed_line(lines, number);
  reply_lines(request, std::move(lines), now);
}

/// Kept until a power cycle puts it into effect (PROTOCOLS section 13).
void ScipDevice::set_address(const scip::Request& request, SimTime now) {
  const std::string_view text = request.body.substr(3);
  constexpr std::size_t kPart = 3;
  for (std::size_t at = 0; at < text.size(); at += kPart) {
    const auto part = scip::parse_digits(text.substr(at, kPart));
    if (!part || *part > 255) return reply(request.line, "01", now);
  }
  if (streaming_) return reply(request.line, "10", now);
  network_.next = std::string(text);
  reply(request.line, "00", now);
}

void ScipDevice::wedge(const scip::Request& /*request*/, SimTime /*now*/) {
  wedged_ = true;
  to_idle();
}

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/monitor.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "daemon/app/workers.hpp"
#include "drivers/pioneer/base_connector.hpp"

namespace topo::daemon {
std::string state_text(const BaseReport& base) {
  const pipeline::ControlReport& control = base.control;
  if (control.estop_latched) return std::string(motion::to_text(motion::GateReason::kEmergencyStop));
  if (!base.ready) return "base not connected";
  if (control.plausibility.doubts.any())
    return fmt::format("stopped: {}", plausibility::found_text(control.plausibility.doubts));
  if (control.mode == pipeline::ControlMode::kStanding) return "standing";
  const bool as_asked =
      control.reason == motion::GateReason::kFree || control.reason == motion::GateReason::kLimited;
  return as_asked ? "driving" : std::string(motion::to_text(control.reason));
}

namespace {

// Longer than any wait or computation of a healthy thread.
constexpr types::Duration kStuckAfter = std::chrono::milliseconds(1500);
// Planning computes longer on a large map; the base stops by itself when its plan is too old.
constexpr types::Duration kPlanningStuckAfter = std::chrono::seconds(10);

/// Nothing when the base is not on a CAN bus.
std::optional<DoctorFacts::Can> can_facts(const std::string& base_address) {
  const auto address = pioneer::parse_can_address(base_address);
  if (!address || !*address) return std::nullopt;
  const auto known = io::query_can_interface((*address)->interface);
  if (!known) return DoctorFacts::Can{(*address)->interface, {}, known.error().message};
  return DoctorFacts::Can{(*address)->interface, *known};
}

}  // namespace

Monitor::Monitor(const Configuration& configuration, HandOvers& hand_overs, const Workers& workers)
    : configuration_(configuration), hand_overs_(hand_overs), workers_(workers) {
  devices_.push_back({"base", &hand_overs.base.device, {}});
  devices_.push_back({"front", &hand_overs.front.report, {}});
  if (configuration.coronal.present) devices_.push_back({"coronal", &hand_overs.coronal.report, {}});
  for (const Vitals* vitals : workers.vital()) {
    const bool planning = vitals->name == "planning";
    pulses_.push_back({vitals, planning ? kPlanningStuckAfter : kStuckAfter, 0, {}});
  }
}

void Monitor::update(types::Stamp now) {
  update_devices();
  if (const auto* report = hand_overs_.base.report.take_new(); report != nullptr) {
    if (state_text(*report) != state_text(base_)) spdlog::info("base: {}", state_text(*report));
    const pipeline::ControlReport& heard = report->control;
    if (heard.recoveries > base_.control.recoveries)
      spdlog::info("base: something is in the way: recovery {} begins", heard.recoveries);
    if (heard.mode == pipeline::ControlMode::kStuck && base_.control.mode != heard.mode)
      spdlog::warn("base: stuck, recovery did not help; the goal is given up");
    tell_doubts(base_.control.plausibility.doubts, heard.plausibility.doubts);
    base_ = *report;
  }
  if (const auto* report = hand_overs_.mapping.report.take_new(); report != nullptr) mapping_ = *report;
  update_pulses(now);
  update_tallies(now);
}

void Monitor::tell_doubts(const plausibility::DoubtSet& before, const plausibility::DoubtSet& now) const {
  for (std::size_t i = 0; i < plausibility::kDoubts; ++i) {
    const plausibility::DoubtText& text = plausibility::doubt_texts()[i];
    if (now.test(i) && !before.test(i)) spdlog::warn("stopped: {}: {}", text.found, text.cure);
    if (before.test(i) && !now.test(i)) spdlog::info("no longer: {}", text.found);
  }
}

void Monitor::update_tallies(types::Stamp now) {
  constexpr types::Duration kApart = std::chrono::seconds(1);
  constexpr std::size_t kKept = 10;
  if (!tallies_.empty() && now - tallies_.back().stamp < kApart) return;
  tallies_.push_back({now, mapping_.matched, mapping_.lost, devices_.front().report.bus});
  if (tallies_.size() > kKept) tallies_.pop_front();
}

void Monitor::note_refusal(const std::string& refusal) {
  spdlog::warn("{}", refusal);
  refusals_.push_back(refusal);
}

DoctorFacts Monitor::facts() const {
  DoctorFacts facts;
  const Configuration& c = configuration_;
  facts.configuration = c;
  for (const Device& device : devices_) {
    const std::string& address = device.name == "base"    ? c.base.address
                                 : device.name == "front" ? c.front.address
                                                          : c.coronal.address;
    facts.devices.push_back({std::string(device.name), address, device.report.state.str(),
                             device.report.message.str(), device.report.working,
                             device.report.assumed.str()});
    if (device.name == "base" && device.report.watchdog_ms >= 0) {
      facts.watchdog_ms = device.report.watchdog_ms;
      facts.watchdog_given = device.report.watchdog_given;
    }
  }
  facts.can = can_facts(c.base.address);
  if (facts.can && !tallies_.empty()) {
    facts.can->faults_lately = devices_.front().report.bus;
    facts.can->faults_lately -= tallies_.front().bus;
  }
  facts.base = base_;
  facts.battery = c.exploration.battery_limits();
  facts.has_map = has_map();
  if (!tallies_.empty()) {
    facts.scans_matched_lately = mapping_.matched - tallies_.front().matched;
    facts.scans_lost_lately = mapping_.lost - tallies_.front().lost;
  }
  facts.policy = c.realtime.policy;
  facts.refusals = refusals_;
  for (const auto name : stuck_) facts.stuck.emplace_back(name);
  if (c.session.journal) facts.sessions = c.session.folder;
  for (const std::string& folder : {c.exploration.save_folder, c.record.folder, c.session.folder}) {
    if (!folder.empty()) facts.disks.push_back({folder});
  }
  return facts;
}

void Monitor::update_devices() {
  for (Device& device : devices_) {
    const DeviceReport* report = device.source->take_new();
    if (report == nullptr) continue;
    const bool changed = report->state.view() != device.report.state.view() ||
                         report->message.view() != device.report.message.view();
    if (changed && !report->message.view().empty()) {
      spdlog::log(report->working ? spdlog::level::info : spdlog::level::warn, "{}: {}: {}", device.name,
                  report->state.view(), report->message.view());
    }
    if (report->assumed.view() != device.report.assumed.view() && !report->assumed.view().empty())
      spdlog::warn("{}: assumed: {}", device.name, report->assumed.view());
    device.report = *report;
  }
}

void Monitor::update_pulses(types::Stamp now) {
  std::vector<std::string_view> stuck;
  for (Pulse& pulse : pulses_) {
    const std::uint64_t beats = pulse.vitals->beats.load(std::memory_order_relaxed);
    if (beats != pulse.beats || pulse.changed == types::Stamp{}) {
      pulse.beats = beats;
      pulse.changed = now;
    }
    if (now - pulse.changed > pulse.patience) stuck.push_back(pulse.vitals->name);
  }
  if (stuck != stuck_ && !stuck.empty())
    spdlog::error("threads that do not advance: {}", fmt::join(stuck, ", "));
  stuck_ = std::move(stuck);
}

std::string Monitor::obstacle_of(const Device& device) {
  const std::string_view message = device.report.message.view();
  const std::string_view state = device.report.state.view();  // empty before the thread's first report
  return fmt::format("{} is not ready: {}{}{}", device.name, state.empty() ? "starting" : state,
                     message.empty() ? "" : ": ", message);
}

std::string Monitor::device_obstacle() const {
  for (const Device& device : devices_)
    if (!device.report.working) return obstacle_of(device);
  return base_obstacle();
}

std::string Monitor::base_obstacle() const {
  if (base_.ready) return {};
  const Device& base = devices_.front();
  return base.report.working ? "base is not ready: it takes no commands yet" : obstacle_of(base);
}

types::Se2 Monitor::pose_at(types::Stamp at) const {
  constexpr double kLongest_s = 0.5;  // beyond that the speed says nothing
  const types::Odometry& newest = base_.state.odometry;
  const double time_s = std::clamp(types::to_seconds(at - newest.stamp), -kLongest_s, kLongest_s);
  const double way_m = newest.twist.v_mps * time_s, turn_rad = newest.twist.omega_radps * time_s;
  return pose() * types::Se2{way_m * std::cos(turn_rad / 2.0), way_m * std::sin(turn_rad / 2.0), turn_rad};
}

/// As recent as the odometry: the last correction applied to it.
types::Se2 Monitor::pose() const { return (mapping_.T_map_odom * base_.state.odometry.T_odom_base).se2(); }

std::string Monitor::summary() const {
  return fmt::format("{}; {} keyframes, map revision {}", state_text(base_), mapping_.keyframes,
                     mapping_.revision);
}

}  // namespace topo::daemon

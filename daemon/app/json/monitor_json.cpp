// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Answers of the control socket about devices, map and threads.
#include <fmt/format.h>

#include "daemon/app/monitor.hpp"
#include "daemon/app/workers.hpp"
#include "drivers/io/bus_faults.hpp"

namespace topo::daemon {
namespace {

Json pose_json(const types::Se2& pose) {
  return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}};
}

Json histogram_json(const sync::Histogram& histogram) {
  constexpr double kMs = 1e-6;
  const auto s = histogram.summary();
  return {{"count", s.count},
          {"mean_ms", s.mean_ns * kMs},
          {"p50_ms", static_cast<double>(s.p50_ns) * kMs},
          {"p99_ms", static_cast<double>(s.p99_ns) * kMs},
          {"p999_ms", static_cast<double>(s.p999_ns) * kMs},
          {"max_ms", static_cast<double>(s.max_ns) * kMs}};
}

Json plausibility_json(const plausibility::Opinion& opinion) {
  Json doubts = Json::array();
  for (std::size_t i = 0; i < plausibility::kDoubts; ++i) {
    const plausibility::DoubtText& text = plausibility::doubt_texts()[i];
    if (opinion.doubts.test(i))
      doubts.push_back({{"name", text.name}, {"found", text.found}, {"cure", text.cure}});
  }
  return {{"doubts", std::move(doubts)},
          {"lag_s", types::to_seconds(opinion.lag)},
          {"scan_late_s", types::to_seconds(opinion.scan_late)},
          {"status_late_s", types::to_seconds(opinion.status_late)},
          {"deceleration_mps2", opinion.deceleration_mps2}};
}

Json bus_json(const io::BusFaults& faults) {
  Json json = Json::object();
  for (const auto& [fault, key, words] : io::bus_fault_names()) json[std::string(key)] = faults[fault];
  return json;
}

}  // namespace

Json Monitor::status() const {
  const pipeline::ControlReport& control = base_.control;
  return {{"robot", configuration_.robot.name},
          {"model", model_name(configuration_.robot.model)},
          {"state", state_text(base_)},
          {"free_distance_m", control.free_distance_m},
          {"control",
           {{"mode", to_text(control.mode)},
            {"recoveries", control.recoveries},
            {"plans_missed", hand_overs_.plan.overwritten()}}},
          {"pose", pose_json(pose())},
          {"odometry", pose_json(base_.state.odometry.T_odom_base.se2())},
          {"twist",
           {{"v_mps", base_.state.odometry.twist.v_mps},
            {"omega_radps", base_.state.odometry.twist.omega_radps}}},
          {"commanded", {{"v_mps", control.commanded.v_mps}, {"omega_radps", control.commanded.omega_radps}}},
          {"limits",
           {{"v_max_mps", configuration_.base.v_max_mps},
            {"omega_max_radps", configuration_.base.omega_max_radps}}},
          {"battery_v", base_.state.battery_v},
          {"motors_enabled", base_.state.motors_enabled},
          {"stall", base_.state.stall_left || base_.state.stall_right},
          {"bumpers", {{"front", base_.state.bumpers_front}, {"rear", base_.state.bumpers_rear}}},
          {"plausibility", plausibility_json(control.plausibility)},
          {"map", map()},
          {"devices", devices()}};
}

Json Monitor::map() const {
  const auto& front = hand_overs_.front.to_mapping;
  const auto& coronal = hand_overs_.coronal.to_mapping;
  return {{"revision", mapping_.revision},
          {"keyframes", mapping_.keyframes},
          {"keyframes_of_all", mapping_.keyframes_of_all},
          {"scans_matched", mapping_.matched},
          {"scans_lost", mapping_.lost},
          {"scans_skipped", front.skipped() + coronal.skipped()},
          {"scans_rejected", front.rejected() + coronal.rejected()},
          {"scans_without_odometry", mapping_.losses.without_odometry},
          {"scans_waited_in_vain", mapping_.losses.queue_full},
          {"odometry_rejected", hand_overs_.base.odometry.rejected()},
          {"closures", {{"accepted", mapping_.closures_accepted}, {"rejected", mapping_.closures_rejected}}},
          {"response", mapping_.response}};
}

Json Monitor::devices() const {
  Json json = Json::object();
  for (const Device& device : devices_) {
    const auto& c = device.report.counters;
    Json counters = device.name == "base"
                        ? Json{{"status_packets", c[0]}, {"bad_packets", c[1]}, {"lost_packets", c[2]},
                               {"reconnects", c[3]},     {"commands", c[4]},    {"bytes", c[5]}}
                        : Json{{"scans", c[0]},      {"checksum_errors", c[1]}, {"resyncs", c[2]},
                               {"reconnects", c[3]}, {"lost_scans", c[4]},      {"bytes", c[5]}};
    if (device.name == "base" && configuration_.base.address.starts_with("can:"))
      counters["bus"] = bus_json(device.report.bus);
    json[std::string(device.name)] = {
        {"state", device.report.state.view()},       {"message", device.report.message.view()},
        {"identity", device.report.identity.view()}, {"assumed", device.report.assumed.view()},
        {"working", device.report.working},          {"counters", std::move(counters)}};
  }
  return json;
}

Json Monitor::health() const {
  Json faults = Json::array();
  for (const auto name : stuck_) faults.push_back(fmt::format("thread {} does not advance", name));
  for (const Device& device : devices_) {
    if (device.report.working) continue;
    faults.push_back(
        fmt::format("{}: {}: {}", device.name, device.report.state.view(), device.report.message.view()));
  }
  for (std::size_t i = 0; i < plausibility::kDoubts; ++i) {
    if (base_.control.plausibility.doubts.test(i))
      faults.push_back(std::string(plausibility::doubt_texts()[i].found));
  }
  const bool healthy = faults.empty();
  Json assumed = Json::array();
  for (const Device& device : devices_) {
    if (!device.report.assumed.view().empty())
      assumed.push_back(fmt::format("{}: {}", device.name, device.report.assumed.view()));
  }
  return {{"healthy", healthy},
          {"alive", alive()},
          {"faults", std::move(faults)},
          {"assumed", std::move(assumed)}};
}

Json Monitor::latency() const {
  Json json = Json::object();
  for (const Vitals* vitals : workers_.all()) {
    json[std::string(vitals->name)] = {{"wake", histogram_json(vitals->wake)},
                                       {"run", histogram_json(vitals->run)},
                                       {"overruns", vitals->overruns.load(std::memory_order_relaxed)}};
  }
  return json;
}

}  // namespace topo::daemon

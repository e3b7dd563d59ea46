// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/topoctl/tables.hpp"

#include <fmt/format.h>

#include <string_view>

namespace topo::daemon {
namespace {

/// The member at a path such as "/map/keyframes"; null when it is not there.
const Json& at(const Json& json, const char* path) {
  static const Json none;
  const Json::json_pointer pointer(path);
  return json.contains(pointer) ? json[pointer] : none;
}

std::string text(const Json& json, const char* path) {
  const Json& value = at(json, path);
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.3f}", value.get<double>());
  if (value.is_number()) return fmt::format("{}", value.get<std::int64_t>());
  return "-";
}

std::string row(std::string_view name, const std::string& value) {
  return fmt::format("{:<12}{}\n", name, value);
}

std::string pose_text(const Json& json, const std::string& path) {
  return fmt::format("x {} m, y {} m, heading {} rad", text(json, (path + "/x_m").c_str()),
                     text(json, (path + "/y_m").c_str()), text(json, (path + "/theta_rad").c_str()));
}

}  // namespace

std::string status_table(const Json& status) {
  std::string out = row("robot", fmt::format("{} ({})", text(status, "/robot"), text(status, "/model")));
  out += row("state", text(status, "/state"));
  out += row("e-stop", text(status, "/estop"));
  out += row("pose", pose_text(status, "/pose"));
  out += row("odometry", pose_text(status, "/odometry"));
  out += row("speed", fmt::format("{} m/s, {} rad/s", text(status, "/twist/v_mps"),
                                  text(status, "/twist/omega_radps")));
  out += row("battery", text(status, "/battery_v") + " V");
  out += row("map", fmt::format("revision {}, {} keyframes, {} closures", text(status, "/map/revision"),
                                text(status, "/map/keyframes"), text(status, "/map/closures/accepted")));
  out += row("scans", fmt::format("{} matched, {} lost, {} skipped", text(status, "/map/scans_matched"),
                                  text(status, "/map/scans_lost"), text(status, "/map/scans_skipped")));
  const Json& devices = at(status, "/devices");
  if (!devices.is_object()) return out;
  for (const auto& [name, device] : devices.items()) {
    out += row(name, fmt::format("{}; {}", text(device, "/state"), text(device, "/message")));
  }
  return out;
}

std::string latency_table(const Json& latency) {
  std::string out = fmt::format("{:<10}{:<6}{:>10}{:>11}{:>11}{:>11}{:>11}{:>10}\n", "thread", "what",
                                "count", "p50 ms", "p99 ms", "p99.9 ms", "max ms", "overruns");
  if (!latency.is_object()) return out;
  for (const auto& [thread, values] : latency.items()) {
    for (const char* what : {"wake", "run"}) {
      const Json& h = at(values, (std::string("/") + what).c_str());
      out += fmt::format("{:<10}{:<6}{:>10}{:>11}{:>11}{:>11}{:>11}{:>10}\n", thread, what, text(h, "/count"),
                         text(h, "/p50_ms"), text(h, "/p99_ms"), text(h, "/p999_ms"), text(h, "/max_ms"),
                         text(values, "/overruns"));
    }
  }
  return out;
}

std::string health_table(const Json& health) {
  std::string out = row("healthy", text(health, "/healthy"));
  const Json& faults = at(health, "/faults");
  if (!faults.is_array()) return out;
  for (const Json& fault : faults) out += row("fault", fault.is_string() ? fault.get<std::string>() : "-");
  return out;
}

}  // namespace topo::daemon

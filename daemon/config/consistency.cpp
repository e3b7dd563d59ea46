// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/consistency.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "daemon/config/forward_view.hpp"
#include "daemon/config/masks.hpp"
#include "drivers/pioneer/robot_models.hpp"

namespace topo::daemon {
namespace {

Place place_of(const LoadedConfiguration& loaded, std::string_view key) {
  const auto found = loaded.places.find(key);
  return found == loaded.places.end() ? Place{} : found->second;
}

/// Adds the fault at the later of the two keys in the file.
void contradict(LoadedConfiguration& loaded, std::string_view a, std::string_view b, std::string_view what) {
  Place place = place_of(loaded, a);
  Place other = place_of(loaded, b);
  if (place < other) {
    std::swap(a, b);
    std::swap(place, other);
  }
  const std::string where = other.line > 0 ? fmt::format("line {}", other.line) : std::string("by default");
  loaded.faults.push_back({place, fmt::format("{} contradicts {} ({}): {}", a, b, where, what)});
}

char to_small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

constexpr std::string_view kSerial = "serial:";

/// An absolute path without empty parts, "." and "..", by its text alone.
std::string normal_path(std::string_view path) {
  std::string normal;
  while (!path.empty()) {
    path.remove_prefix(1);  // the slash
    const std::string_view part = path.substr(0, path.find('/'));
    path.remove_prefix(part.size());
    if (part.empty() || part == ".") continue;
    if (part == "..")
      normal.resize(normal.empty() ? 0 : normal.rfind('/'));
    else
      normal.append("/").append(part);
  }
  return normal;
}

/// The address in the form used for comparison: a path without prefix, "//" and "..", a host in small
/// letters.
std::string same_device(std::string_view address) {
  std::string_view path = address;
  if (path.starts_with(kSerial)) path.remove_prefix(kSerial.size());
  if (path.starts_with("/")) return normal_path(path);
  std::string text(address);
  if (text.starts_with("tcp:")) std::transform(text.begin(), text.end(), text.begin(), to_small);
  return text;
}

bool is_serial(std::string_view address) { return same_device(address).starts_with("/"); }

void check_addresses(LoadedConfiguration& loaded) {
  struct Device {
    std::string_view key;
    std::string address;
  };
  const Configuration& c = loaded.values;
  const std::array<Device, 3> devices{{{"base.address", same_device(c.base.address)},
                                       {"scanner.front.address", same_device(c.front.address)},
                                       {"scanner.coronal.address", same_device(c.coronal.address)}}};
  for (std::size_t i = 0; i < devices.size(); ++i) {
    for (std::size_t j = i + 1; j < devices.size(); ++j) {
      const std::string& a = devices[i].address;
      if (a.empty() || a != devices[j].address) continue;
      contradict(loaded, devices[i].key, devices[j].key,
                 fmt::format("both are {}; every device has an address of its own", a));
    }
  }
}

void check_serial_numbers(LoadedConfiguration& loaded) {
  const Configuration& c = loaded.values;
  if (!c.front.present || !c.coronal.present) return;
  const bool both_named = !c.front.serial_number.empty() && !c.coronal.serial_number.empty();
  if (both_named) {
    if (normal_serial_number(c.front.serial_number) != normal_serial_number(c.coronal.serial_number)) return;
    contradict(loaded, "scanner.front.serial_number", "scanner.coronal.serial_number",
               fmt::format("both are \"{}\"; the two sensors are told apart by their serial numbers",
                           c.front.serial_number));
    return;
  }
  // Kernel names such as ttyACM0 depend on the order of plugging: only the serial number identifies a sensor.
  const bool both_serial = is_serial(c.front.address) && is_serial(c.coronal.address);
  if (!both_serial) return;
  for (const auto* section : {"scanner.front", "scanner.coronal"}) {
    const ScannerConfig& scanner = section == std::string_view("scanner.front") ? c.front : c.coronal;
    if (!scanner.serial_number.empty()) continue;
    loaded.faults.push_back(
        {place_of(loaded, fmt::format("{}.address", section)),
         fmt::format(
             "{}.serial_number is missing: two sensors on serial devices are told apart by their serial "
             "numbers, expected one such as \"H0902680\"",
             section)});
  }
}

void check_forward_view(LoadedConfiguration& loaded) {
  const std::string fault = forward_view_fault(loaded.values.front.yaw_rad);
  if (fault.empty()) return;
  loaded.faults.push_back({place_of(loaded, "scanner.front.yaw_rad"), "scanner.front.yaw_rad: " + fault});
}

/// The mapper takes the front scanner's plane for level.
void check_front_mount(LoadedConfiguration& loaded) {
  constexpr double kLevel_rad = 0.1;  // 0.5 % of every distance to the side
  const ScannerConfig& front = loaded.values.front;
  if (std::abs(std::sin(front.roll_rad)) > std::sin(kLevel_rad)) {
    loaded.faults.push_back(
        {place_of(loaded, "scanner.front.roll_rad"),
         fmt::format("scanner.front.roll_rad: found {}, expected 0 (upright) or 3.1416 (upside down), either "
                     "within {}: the map needs a level plane",
                     front.roll_rad, kLevel_rad)});
  }
  if (const std::string fault = masks_fault(front.masks); !fault.empty())
    loaded.faults.push_back(
        {place_of(loaded, "scanner.front.masks_deg"), "scanner.front.masks_deg: " + fault});
}

void check_model(LoadedConfiguration& loaded) {
  const Configuration& c = loaded.values;
  if (place_of(loaded, "robot.model") == Place{}) return;
  const types::ModelSize model = model_size(c.robot.model);
  const pioneer::RobotModel* family = pioneer::find_model(c.base.family);
  if (family != nullptr && family->chassis != (c.robot.model == RobotModel::kP3at ? "p3at" : "p3dx")) {
    contradict(loaded, "base.family", "robot.model",
               fmt::format("found \"{}\", which is a {}", c.base.family, family->chassis));
  }
  struct Least {
    std::string_view key;
    double value, least;
  };
  for (const auto& [key, value, least] :
       {Least{"robot.length_front_m", c.robot.length_front_m, model.front_m},
        Least{"robot.length_rear_m", c.robot.length_rear_m, model.rear_m},
        Least{"robot.width_m", c.robot.width_m, model.width_m}}) {
    if (value == 0.0 || value >= least) continue;
    contradict(
        loaded, key, "robot.model",
        fmt::format(
            "found {}, a {} measures {} m without anything bolted on; expected 0 (as the model) or more "
            "than that",
            value, model_name(c.robot.model), least));
  }
  for (const auto& [key, value, most] :
       {Least{"base.v_max_mps", c.base.v_max_mps, model.v_max_mps},
        Least{"base.omega_max_radps", c.base.omega_max_radps, model.omega_max_radps}}) {
    if (value <= most) continue;
    contradict(loaded, key, "robot.model",
               fmt::format("found {}, a {} does at most {}", value, model_name(c.robot.model), most));
  }
}

/// The robot starts at the origin.
void check_area(LoadedConfiguration& loaded) {
  const types::AreaLimits& area = loaded.values.area;
  const types::Vector2 start{0.0, 0.0};
  if (area.keep_in && !types::allows({area.keep_in, {}}, start)) {
    loaded.faults.push_back({place_of(loaded, "area.keep_in_m"),
                             "area.keep_in_m: the start (0, 0) is outside or on the edge, expected an area "
                             "that the robot stands in when it starts"});
  }
  for (std::size_t i = 0; i < area.keep_out.size(); ++i) {
    if (types::allows({std::nullopt, {area.keep_out[i]}}, start)) continue;
    loaded.faults.push_back({place_of(loaded, "area.keep_out_m"),
                             fmt::format("area.keep_out_m: the start (0, 0) is in area {}, expected areas "
                                         "that the robot does not stand in when it starts",
                                         i + 1)});
  }
}

void check_team(LoadedConfiguration& loaded) {
  const Configuration& c = loaded.values;
  if (!c.team.present) return;
  if (place_of(loaded, "team.id").line > 0 && c.team.id != c.robot.id) {
    contradict(
        loaded, "team.id", "robot.id",
        fmt::format("found {} and {}, the robot has one number; expected the same, or robot.id left out",
                    c.team.id, c.robot.id));
  }
  const auto& peers = c.team.peers;
  for (std::size_t i = 0; i < peers.size(); ++i) {
    if (std::find(peers.begin(), peers.begin() + static_cast<std::ptrdiff_t>(i), peers[i]) ==
        peers.begin() + static_cast<std::ptrdiff_t>(i))
      continue;
    loaded.faults.push_back(
        {place_of(loaded, "team.peers"),
         fmt::format("team.peers: found {} twice, expected every address once", peers[i])});
  }
  if (normal_path(c.team.socket) == normal_path(c.control.socket)) {
    contradict(loaded, "team.socket", "control.socket",
               fmt::format("both are {}; the link has a socket of its own", c.team.socket));
  }
}

void check_the_rest(LoadedConfiguration& loaded) {
  const RealtimeConfig& r = loaded.values.realtime;
  if (r.scan_priority >= r.base_priority) {
    contradict(loaded, "realtime.scan_priority", "realtime.base_priority",
               fmt::format("found {} and {}, the base thread must go before the scan threads",
                           r.scan_priority, r.base_priority));
  }
  const auto& heights = loaded.values.mapping.coronal;
  if (heights.height_min_m >= heights.height_max_m) {
    contradict(loaded, "mapping.height_min_m", "mapping.height_max_m",
               fmt::format("found {} and {}, floor must be below ceiling", heights.height_min_m,
                           heights.height_max_m));
  }
}

}  // namespace

std::string normal_serial_number(std::string_view text) {
  std::string normal(text);
  std::transform(normal.begin(), normal.end(), normal.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  if (!normal.empty() && normal.front() == '0') normal.front() = 'H';
  return normal;
}

void check_consistency(LoadedConfiguration& loaded) {
  check_addresses(loaded);
  check_serial_numbers(loaded);
  check_forward_view(loaded);
  check_front_mount(loaded);
  check_model(loaded);
  check_area(loaded);
  check_team(loaded);
  check_the_rest(loaded);
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "tests/sim/devices/sim_rig.hpp"

/// What a command of the control protocol is made of.
namespace topo::sim {

using nlohmann::json;

/// The arguments of one command. Each is read by name and range; the first fault is kept. An argument that is
/// not read is a fault.
class Arguments {
 public:
  explicit Arguments(const json& object) : object_(object) { known_ = {"command"}; }

  double number(const std::string& key, double low, double high, std::optional<double> otherwise = {}) {
    known_.insert(key);
    if (!object_.contains(key)) {
      if (!otherwise) fault("missing \"" + key + "\"");
      return otherwise.value_or(low);
    }
    const json& value = object_.at(key);
    const double got = value.is_number() ? value.get<double>() : std::nan("");
    if (std::isfinite(got) && got >= low && got <= high) return got;
    fault("\"" + key + "\" is " + value.dump() + ", expected a number from " + json(low).dump() + " to " +
          json(high).dump());
    return low;
  }

  /// The same for an integer.
  std::int64_t whole(const std::string& key, double low, double high, std::optional<double> otherwise = {}) {
    const double got = number(key, low, high, otherwise);
    if (got == std::trunc(got)) return static_cast<std::int64_t>(got);
    fault("\"" + key + "\" is " + object_.at(key).dump() + ", expected a whole number");
    return static_cast<std::int64_t>(low);
  }

  bool boolean(const std::string& key, bool otherwise) {
    known_.insert(key);
    if (!object_.contains(key)) return otherwise;
    if (object_.at(key).is_boolean()) return object_.at(key).get<bool>();
    fault("\"" + key + "\" is " + object_.at(key).dump() + ", expected true or false");
    return otherwise;
  }

  /// Index of the value among the allowed ones.
  std::size_t choice(const std::string& key, std::span<const std::string_view> allowed,
                     std::optional<std::size_t> otherwise = {}) {
    known_.insert(key);
    std::string all;
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      if (object_.contains(key) && object_.at(key) == allowed[i]) return i;
      all.append(i == 0 ? "" : ", ").append(allowed[i]);
    }
    if (!object_.contains(key) && otherwise) return *otherwise;
    fault("\"" + key + "\" is " + (object_.contains(key) ? object_.at(key).dump() : "missing") +
          ", expected one of " + all);
    return 0;
  }

  void fault(std::string text) {
    if (fault_.empty()) fault_ = std::move(text);
  }
  /// Empty when all arguments read were valid and no others were given.
  [[nodiscard]] std::string finish() {
    for (const auto& [key, value] : object_.items()) {
      if (!known_.contains(key)) fault("unknown argument \"" + key + "\"");
    }
    return fault_;
  }

 private:
  const json& object_;
  std::set<std::string> known_;
  std::string fault_;
};

struct Context {
  SimRig& rig;
  Arguments& arguments;

  RobotRig& robot() const { return rig.robot(robot_index()); }
  std::size_t robot_index() const {
    return static_cast<std::size_t>(
        arguments.whole("robot", 0, static_cast<double>(rig.robot_count() - 1), 0));
  }
  DeviceId device() const { return static_cast<DeviceId>(arguments.choice("device", kDeviceNames)); }
  DeviceId laser() const {
    return static_cast<DeviceId>(arguments.choice("device", std::span(kDeviceNames).first(2)));
  }
  SimTime until(double otherwise_s) const {
    return rig.now() + sim_seconds(arguments.number("seconds", 0, 1e6, otherwise_s));
  }
};

inline json done() { return json::object(); }

/// The prepared effect of a command; runs only when all arguments are valid.
using Action = std::function<json()>;

/// One command; `help` follows its name in the help text.
struct Command {
  std::string_view name;
  std::string_view help;
  Action (*prepare)(const Context&);
};

/// Faults in which everything arrives, in form and in time, and is wrong (content_commands.cpp).
[[nodiscard]] std::span<const Command> content_commands();

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/commands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "tests/sim/devices/sim_rig.hpp"

namespace topo::sim {
namespace {

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

/// The prepared effect of a command; runs only when all arguments are valid.
using Action = std::function<json()>;

json done() { return json::object(); }

Action truth(const Context& c) {
  return [&rig = c.rig] {
    json robots = json::array();
    for (std::size_t i = 0; i < rig.robot_count(); ++i) {
      const Truth t = rig.truth(i);
      robots.push_back({{"x_m", t.pose.x_m},
                        {"y_m", t.pose.y_m},
                        {"theta_rad", t.pose.theta_rad},
                        {"collisions", t.collisions},
                        {"path_m", t.path_m}});
    }
    const Truth t = rig.truth(0);
    return json{{"t_s", t.steady_s}, {"sim_s", t.sim_s}, {"robots", std::move(robots)}};
  };
}

json device_status(SimRig& rig, std::size_t i) {
  RobotRig& robot = rig.robot(i);
  constexpr std::array<std::string_view, 3> kStates{"wait", "synced", "open"};
  json devices = json::object();
  for (std::size_t d = 0; d < kDeviceCount; ++d) {
    const auto id = static_cast<DeviceId>(d);
    json& entry = devices[std::string(kDeviceNames[d])];
    entry["connected"] = robot.wire(id).connected();
    if (id == DeviceId::kBase) continue;
    entry["laser_on"] = robot.laser(id).laser_on();
    entry["streaming"] = robot.laser(id).streaming();
    entry["scans_dropped"] = robot.laser(id).output().dropped();
  }
  devices["base"]["state"] = kStates[static_cast<std::size_t>(robot.base().state())];
  devices["base"]["motors_on"] = robot.base().motors_on();
  devices["base"]["watchdog_holds"] = robot.base().watchdog_holds(rig.now());
  devices["base"]["e_stops"] = robot.base().e_stops();
  devices["base"]["bad_packets"] = robot.base().bad_packets();
  return devices;
}

Action status(const Context& c) {
  return [&rig = c.rig] {
    json robots = json::array();
    for (std::size_t i = 0; i < rig.robot_count(); ++i) robots.push_back(device_status(rig, i));
    return json{{"robots", std::move(robots)},
                {"sim_s", seconds_of(rig.now())},
                {"overruns", rig.overruns()},
                {"lost_s", rig.lost_s()},
                {"difficulty", rig.config().difficulty.text()}};
  };
}

Action silence(const Context& c) {
  return [&wire = c.robot().wire(c.device()), until = c.until(1e6)] { return wire.silence(until), done(); };
}
Action garbage(const Context& c) {
  return [&wire = c.robot().wire(c.device()),
          bytes = static_cast<std::size_t>(c.arguments.whole("bytes", 1, 1e6, 200))] {
    return wire.garbage(bytes), done();
  };
}
Action cut(const Context& c) {
  return [&wire = c.robot().wire(c.device()), until = c.until(2.0)] { return wire.cut(until), done(); };
}
Action slow(const Context& c) {
  return [&wire = c.robot().wire(c.device()), rate = c.arguments.number("bytes_per_s", 0, 1e9)] {
    return wire.slow(rate), done();
  };
}
Action drop(const Context& c) {
  return [&wire = c.robot().wire(c.device()), rate = c.arguments.number("rate", 0, 1)] {
    return wire.drop(rate), done();
  };
}

Action dead(const Context& c) {
  static constexpr std::array<std::string_view, 3> kModes{"good", "fault", "silent"};
  return [&laser = c.robot().laser(c.laser()),
          health = static_cast<ScipHealth>(c.arguments.choice("mode", kModes, 2)),
          now = c.rig.now()] { return laser.set_health(health, now), done(); };
}

Action reset(const Context& c) {
  return [&robot = c.robot(), device = c.device(), now = c.rig.now()] {
    if (device == DeviceId::kBase) {
      robot.base().controller_reset(now);
    } else {
      robot.laser(device).power_cycle(now);
    }
    return done();
  };
}

Action stop_button(const Context& c) {
  return [&robot = c.robot(), pressed = c.arguments.boolean("pressed", true)] {
    return robot.base().set_stop_button(pressed), done();
  };
}

Action bumper(const Context& c) {
  constexpr double kAllSegments = 127;
  return [&robot = c.robot(), front = c.arguments.whole("front", 0, kAllSegments, 0),
          rear = c.arguments.whole("rear", 0, kAllSegments, 0), until = c.until(0.5)] {
    robot.base().press_bumpers(static_cast<std::uint8_t>(front), static_cast<std::uint8_t>(rear), until);
    return done();
  };
}

Action battery(const Context& c) {
  return [&robot = c.robot(), volts = c.arguments.number("volts", 0, 60)] {
    return robot.base().set_battery(volts), done();
  };
}

Action clock_jump(const Context& c) {
  return [&laser = c.robot().laser(c.laser()), ms = c.arguments.number("ms", -1.7e7, 1.7e7)] {
    return laser.jump_clock(ms), done();
  };
}

Action obstacle(const Context& c) {
  return
      [&rig = c.rig, robot = c.robot_index(), distance = c.arguments.number("distance_m", 0, 100)]() -> json {
        auto id = rig.simulation().add_box_ahead(robot, distance);
        if (!id.has_value()) return {{"ok", false}, {"error", id.error().message}};
        return {{"id", *id}};
      };
}

Action remove_obstacle(const Context& c) {
  return [&rig = c.rig, id = c.arguments.whole("id", 0, 1e6)]() -> json {
    const auto removed = rig.simulation().remove_obstacle(static_cast<MovableId>(id));
    if (!removed) return {{"ok", false}, {"error", "remove-obstacle: " + removed.error().message}};
    return done();
  };
}

struct Command {
  std::string_view name;
  std::string_view help;
  Action (*prepare)(const Context&);
};

constexpr std::array kCommands{
    Command{"truth", "true poses, collisions, way and time of all robots", truth},
    Command{"status", "who is connected, states, overruns, difficulty", status},
    Command{"silence", "device [seconds]: nothing comes from it any more", silence},
    Command{"garbage", "device [bytes=200]: random bytes among its own", garbage},
    Command{"cut", "device [seconds=2]: the link breaks and comes back", cut},
    Command{"slow", "device bytes_per_s: a slow link; 0 ends it", slow},
    Command{"drop", "device rate: loses this share of the bytes, both ways; 0 ends it", drop},
    Command{"dead", "device=front|coronal [mode=silent|fault|good]", dead},
    Command{"reset", "device: power off and on; a base says 0xFF", reset},
    Command{"stop-button", "[pressed=true]: the robot's STOP button", stop_button},
    Command{"bumper", "[front=MASK] [rear=MASK] [seconds=0.5]: bit 0 is segment 1", bumper},
    Command{"battery", "volts", battery},
    Command{"clock-jump", "device=front|coronal ms: the sensor's clock steps", clock_jump},
    Command{"obstacle", "distance_m: a box appears so far ahead; answers its id", obstacle},
    Command{"remove-obstacle", "id: as obstacle answered it", remove_obstacle},
};

std::string refusal(const std::string& why) { return json{{"ok", false}, {"error", why}}.dump(); }

}  // namespace

std::string command_help() {
  std::string text;
  for (const Command& command : kCommands) {
    text.append("  ").append(command.name);
    text.append(command.name.size() < 16 ? 17 - command.name.size() : 1, ' ');
    text.append(command.help).append("\n");
  }
  return text;
}

std::string run_command(SimRig& rig, const std::string& line) {
  const json request = json::parse(line, nullptr, false);
  if (!request.is_object() || !request.contains("command") || !request.at("command").is_string()) {
    return refusal("expected one JSON object a line with a \"command\"");
  }
  const auto name = request.at("command").get<std::string>();
  const auto found =
      std::find_if(kCommands.begin(), kCommands.end(), [&](const Command& c) { return c.name == name; });
  if (found == kCommands.end())
    return refusal("unknown command \"" + name + "\", expected one of:\n" + command_help());
  Arguments arguments(request);
  const Action action = found->prepare({rig, arguments});
  if (const std::string fault = arguments.finish(); !fault.empty()) return refusal(name + ": " + fault);
  json answer = action();
  if (!answer.contains("ok")) answer["ok"] = true;
  return answer.dump();
}

}  // namespace topo::sim

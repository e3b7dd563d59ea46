// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/commands.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "tests/sim/devices/command_parts.hpp"
#include "tests/sim/shapes.hpp"

namespace topo::sim {
namespace {

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
  devices["base"]["bytes_heard"] = robot.base().bytes_heard();
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
  return [&robot = c.robot(), volts = c.arguments.number("volts", 0, 60),
          fall = c.arguments.number("falls_v_per_s", 0, 60, 0),
          now = c.rig.now()] { return robot.base().set_battery(volts, fall, now), done(); };
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

Action person(const Context& c) {
  constexpr double kFar_m = 20.0, kRadius_m = 0.2, kHeight_m = 1.75;
  const double x_m = c.arguments.number("x_m", -kFar_m, kFar_m);
  const double y_m = c.arguments.number("y_m", -kFar_m, kFar_m);
  return [&rig = c.rig, robot = c.robot_index(), at = Vector2(x_m, y_m)]() -> json {
    const Vector2 stands = rig.simulation().body(robot).truth() * at;
    auto id = rig.simulation().add_obstacle(make_cylinder(stands, kRadius_m, 0.0, kHeight_m));
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
    Command{"battery", "volts [falls_v_per_s=0]", battery},
    Command{"clock-jump", "device=front|coronal ms: the sensor's clock steps", clock_jump},
    Command{"obstacle", "distance_m: a box appears so far ahead; answers its id", obstacle},
    Command{"person", "x_m y_m: stands ahead and to the left of the robot; answers the id", person},
    Command{"remove-obstacle", "id: as obstacle or person answered it", remove_obstacle},
};

std::vector<Command> all_commands() {
  std::vector<Command> all(kCommands.begin(), kCommands.end());
  const auto content = content_commands();
  all.insert(all.end(), content.begin(), content.end());
  return all;
}

std::string refusal(const std::string& why) { return json{{"ok", false}, {"error", why}}.dump(); }

}  // namespace

std::string command_help() {
  std::string text;
  for (const Command& command : all_commands()) {
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
  const std::vector<Command> all = all_commands();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Command& c) { return c.name == name; });
  if (found == all.end())
    return refusal("unknown command \"" + name + "\", expected one of:\n" + command_help());
  Arguments arguments(request);
  const Action action = found->prepare({rig, arguments});
  if (const std::string fault = arguments.finish(); !fault.empty()) return refusal(name + ": " + fault);
  json answer = action();
  if (!answer.contains("ok")) answer["ok"] = true;
  return answer.dump();
}

}  // namespace topo::sim

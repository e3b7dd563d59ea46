// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Faults in which everything arrives, in form and in time, and is wrong.
#include <array>
#include <string_view>

#include "tests/sim/devices/command_parts.hpp"

namespace topo::sim {
namespace {

constexpr double kDelayMost_s = 30.0;

Action delay(const Context& c) {
  static constexpr std::array<std::string_view, 2> kWays{"from", "to"};
  return [&wire = c.robot().wire(c.device()), way = c.arguments.choice("way", kWays, 0),
          constant = sim_seconds(c.arguments.number("seconds", 0, kDelayMost_s)),
          growth = c.arguments.number("grows_s_per_s", 0, 1, 0), now = c.rig.now()] {
    way == 0 ? wire.delay_from_device(constant, growth, now) : wire.delay_to_device(constant, growth, now);
    return done();
  };
}

Action lose(const Context& c) {
  return [&base = c.robot().base(), rate = c.arguments.number("rate", 0, 1)] {
    return base.faults().lost_commands = rate, done();
  };
}

Action disobey(const Context& c) {
  return [&base = c.robot().base(), on = c.arguments.boolean("on", true)] {
    return base.faults().disobeys = on, done();
  };
}

Action freeze(const Context& c) {
  return [&laser = c.robot().laser(c.laser()), on = c.arguments.boolean("on", true)] {
    return laser.faults().frozen = on, done();
  };
}

/// A sector, counter-clockwise from straight ahead; all around when left out.
Mask sector(const Context& c) {
  constexpr double kHalfTurn_deg = 180.0;
  const double per_degree = std::acos(-1.0) / kHalfTurn_deg;
  const double from_deg = c.arguments.number("from_deg", -kHalfTurn_deg, kHalfTurn_deg, -kHalfTurn_deg);
  const double to_deg = c.arguments.number("to_deg", -kHalfTurn_deg, kHalfTurn_deg, kHalfTurn_deg);
  if (!(from_deg < to_deg)) c.arguments.fault("\"to_deg\" is not beyond \"from_deg\"");
  return {from_deg * per_degree, to_deg * per_degree, 0};
}

Action empty(const Context& c) {
  const DeviceId id = c.laser();
  const LaserModel& model = c.rig.simulation().laser(c.robot_index(), static_cast<std::size_t>(id)).model();
  return [&laser = c.robot().laser(id), mask = sector(c), no_return = model.code_no_return,
          on = c.arguments.boolean("on", true)]() mutable {
    mask.reads_mm = no_return;
    laser.faults().mask = on ? std::optional(mask) : std::nullopt;
    return done();
  };
}

Action cover(const Context& c) {
  constexpr double kFar_mm = 60000, kHull_mm = 30;
  return [&laser = c.robot().laser(c.laser()), mask = sector(c),
          reads_mm = static_cast<std::uint32_t>(c.arguments.whole("reads_mm", 0, kFar_mm, kHull_mm)),
          on = c.arguments.boolean("on", true)]() mutable {
    mask.reads_mm = reads_mm;
    laser.faults().mask = on ? std::optional(mask) : std::nullopt;
    return done();
  };
}

Action steps(const Context& c) {
  constexpr double kMost = 1439;
  return [&laser = c.robot().laser(c.laser()), start = static_cast<int>(c.arguments.whole("start", 0, kMost)),
          end = static_cast<int>(c.arguments.whole("end", 0, kMost))]() -> json {
    if (laser.change_steps(start, end)) return done();
    return {{"ok", false}, {"error", "steps: the scanner does not stream, or has no such steps"}};
  };
}

Action swap(const Context& c) {
  return [&robot = c.robot()] { return robot.exchange_scanners(), done(); };
}

Action foreign(const Context& c) {
  return [&robot = c.robot(), device = c.device(), on = c.arguments.boolean("on", true)] {
    return robot.set_foreign(device, on), done();
  };
}

Action replace(const Context& c) {
  return [&robot = c.robot(), device = c.device(), on = c.arguments.boolean("foreign", true),
          until = c.until(2.0), now = c.rig.now()] {
    robot.set_foreign(device, on);
    if (device == DeviceId::kBase) {
      robot.base().power_cycle(now);
    } else {
      robot.laser(device).power_cycle(now);
    }
    robot.wire(device).cut(until);
    return done();
  };
}

Action lie(const Context& c) {
  static constexpr std::array<std::string_view, 5> kFields{"none", "speed", "turning", "position", "heading"};
  return [&base = c.robot().base(), field = c.arguments.choice("field", kFields),
          value = c.arguments.number("value", -30, 30, 0)] {
    base.faults().lie = static_cast<StatusLie>(field);
    base.faults().lie_value = value;
    return done();
  };
}

Action half_open(const Context& c) {
  return [&wire = c.robot().wire(c.device())]() -> json {
    if (wire.forget_client()) return done();
    return {{"ok", false}, {"error", "half-open: the device is not on TCP, or has no client"}};
  };
}

Action carry(const Context& c) {
  constexpr double kFar_m = 1e4, kTurn_rad = 7.0;
  const double x_m = c.arguments.number("x_m", -kFar_m, kFar_m);
  const double y_m = c.arguments.number("y_m", -kFar_m, kFar_m);
  return [&rig = c.rig, i = c.robot_index(),
          pose = types::Se2{x_m, y_m, c.arguments.number("theta_rad", -kTurn_rad, kTurn_rad, 0)}]() -> json {
    RobotBody& body = rig.simulation().body(i);
    constexpr double kLow_m = 0.03, kHigh_m = 0.5;
    const Polygon outline = body.model().footprint();
    if (rig.simulation().world().touch(outline, pose, kLow_m, kHigh_m, body.movable()).touching)
      return {{"ok", false}, {"error", "carry: something stands there"}};
    return body.teleport(pose), done();
  };
}

Action encoder(const Context& c) {
  static constexpr std::array<std::string_view, 2> kSides{"left", "right"};
  return [&base = c.robot().base(), side = c.arguments.choice("side", kSides),
          dead = c.arguments.boolean("dead", true)] {
    (side == 0 ? base.faults().left : base.faults().right).set(dead);
    return done();
  };
}

Action repeat(const Context& c) {
  constexpr double kMost = 10;
  return [&robot = c.robot(), device = c.device(),
          copies = static_cast<std::size_t>(c.arguments.whole("copies", 1, kMost, 2))] {
    WireDevice* const source =
        device == DeviceId::kBase ? static_cast<WireDevice*>(&robot.base()) : &robot.laser(device);
    return source->output().repeat(copies), done();
  };
}

Action replay(const Context& c) {
  constexpr double kMost = 1000, kSome = 10;
  return [&robot = c.robot(), device = c.device(),
          back = static_cast<std::size_t>(c.arguments.whole("back", 0, kMost, kSome))] {
    WireDevice* const source =
        device == DeviceId::kBase ? static_cast<WireDevice*>(&robot.base()) : &robot.laser(device);
    return source->output().replay(back), done();
  };
}

Action motors_off(const Context& c) {
  return [&base = c.robot().base()] { return base.press_motors_button(), done(); };
}

Action stall(const Context& c) {
  return [&base = c.robot().base(), left = c.arguments.boolean("left", true),
          right = c.arguments.boolean("right", true), until = c.until(0.5)] {
    base.faults().stall_left = left;
    base.faults().stall_right = right;
    base.faults().stalled_until = until;
    return done();
  };
}

Action sonar(const Context& c) {
  constexpr double kMost_m = 5.0;
  return [&base = c.robot().base(), stuck = c.arguments.boolean("stuck", true),
          range_m = c.arguments.number("range_m", 0, kMost_m, kMost_m)] {
    base.faults().sonar_stuck_m = stuck ? std::optional(range_m) : std::nullopt;
    return done();
  };
}

Action watchdog(const Context& c) {
  constexpr double kMost_ms = 65535;
  return [&base = c.robot().base(), ms = static_cast<int>(c.arguments.whole("ms", 0, kMost_ms))] {
    return base.set_watchdog(ms), done();
  };
}

Action unplug(const Context& c) {
  return [&robot = c.robot(), until = c.until(2.0)] {
    for (std::size_t d = 0; d < kDeviceCount; ++d) robot.wire(static_cast<DeviceId>(d)).cut(until);
    return done();
  };
}

constexpr std::array kContentCommands{
    Command{"delay", "device seconds [way=from|to] [grows_s_per_s=0]: bytes come late; 0 ends it", delay},
    Command{"lose", "rate: this share of the commands never reaches the base; 0 ends it", lose},
    Command{"disobey", "[on=true]: the base swallows motion commands and stops, all else works", disobey},
    Command{"lie", "field=none|speed|turning|position|heading [value]: valid status packets, wrong", lie},
    Command{"encoder", "side=left|right [dead=true]: it counts no more, its wheel turns on", encoder},
    Command{"motors-off", "the button on the deck switches the motors off", motors_off},
    Command{"stall", "[left=true] [right=true] [seconds=0.5]: wheels are stuck", stall},
    Command{"sonar", "[range_m=5] [stuck=true]: all echoes read this", sonar},
    Command{"watchdog", "ms: of the firmware; the host hears it with its next connection", watchdog},
    Command{"freeze", "device=front|coronal [on=true]: one picture with new stamps", freeze},
    Command{"empty", "device=front|coronal [from_deg] [to_deg] [on=true]: no return", empty},
    Command{"cover", "device=front|coronal [from_deg] [to_deg] [reads_mm=30] [on=true]", cover},
    Command{"steps", "device=front|coronal start end: other steps in mid-stream", steps},
    Command{"swap", "the scanners exchange their places; again: as before", swap},
    Command{"foreign", "device [on=true]: another name and serial number", foreign},
    Command{"replace", "device [foreign=true] [seconds=2]: another device takes its place", replace},
    Command{"repeat", "device [copies=2]: every packet or scan comes so often; 1 ends it", repeat},
    Command{"replay", "device [back=10]: with each comes the one so many before; 0 ends it", replay},
    Command{"half-open", "device: its end of TCP is gone and says nothing; it listens anew", half_open},
    Command{"unplug", "[seconds=2]: all links break and come back at once", unplug},
    Command{"carry", "x_m y_m [theta_rad=0]: the robot is lifted and put down there", carry},
};

}  // namespace

std::span<const Command> content_commands() { return kContentCommands; }

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/doctor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>

#include "core/types/watchdog.hpp"
#include "daemon/app/battery_text.hpp"
#include "daemon/app/device_cure.hpp"
#include "daemon/config/masks.hpp"

namespace topo::daemon {
namespace {

using motion::GateReason;

Check good(std::string name, std::string found) { return {std::move(name), true, std::move(found), {}, {}}; }
Check bad(std::string name, std::string found, std::string cure) {
  return {std::move(name), false, std::move(found), std::move(cure), {}};
}

bool mentions(const std::string& message, int error) {
  return message.find(std::strerror(error)) != std::string::npos;
}

/// How what was assumed of a device that is not known exactly can be seen to be right.
std::string assumption_check(std::string_view device) {
  if (device == "base")
    return "drive 2 m and a turn by hand and compare with topoctl status; base.family takes another board's";
  return "compare a few distances with a tape, and what it shows of nothing near (topoctl status --json)";
}

Check check_device(const DoctorFacts::Device& d) {
  const std::string found =
      fmt::format("{}{}{}", d.state.empty() ? "starting" : d.state, d.message.empty() ? "" : ": ", d.message);
  if (!d.working) return bad(d.name, found, device_cure(d));
  Check check = good(d.name, found);
  if (!d.assumed.empty()) check.safer = d.assumed + "; " + assumption_check(d.name);
  return check;
}

Check check_can(const DoctorFacts::Can& can) {
  if (!can.unknown.empty())
    return bad("can", can.unknown,
               "look yourself (ip -details link show " + can.name +
                   "); a service needs AF_NETLINK among its RestrictAddressFamilies");
  if (const auto complaint = io::complaint_about(can.interface, can.name))
    return bad("can", complaint->found, complaint->cure);
  if (const std::string lately = io::to_text(can.faults_lately); !lately.empty())
    return bad(
        "can", fmt::format("{} is up; in the last seconds: {}", can.name, lately),
        "look at plug, CAN-H and CAN-L, 120 Ohm at both ends, the robot's CAN side, and what else sends on "
        "the bus; topoctl status --json counts on");
  if (can.interface.is_virtual()) return good("can", fmt::format("{} is up, a virtual bus", can.name));
  return good("can",
              fmt::format("{} is up, {} kbit/s", can.name, can.interface.bit_rate_bps.value_or(0) / 1000));
}

Check check_estop(const DoctorFacts& f) {
  const std::string name = "e-stop";
  if (f.base.ready && f.base.state.stop_button) {
    return bad(name, "the stop button on the robot is pressed",
               "pull or turn the button until it springs out, then topoctl clear-estop");
  }
  if (f.estop_latched && !f.estop_trouble.empty()) {
    return bad(
        name, f.estop_trouble,
        "see that control.state_folder is a folder that the daemon's user may write to, with room on its "
        "disk; when the way is clear: topoctl clear-estop");
  }
  if (f.estop_latched) return bad(name, "latched", "when the way is clear: topoctl clear-estop");
  return good(name, "clear");
}

Check check_motors(const DoctorFacts& f) {
  const std::string name = "motors";
  if (!f.base.ready) return bad(name, "unknown: the base is not ready", "first the check \"base\"");
  if (f.base.state.stall_left || f.base.state.stall_right) {
    return bad(name, fmt::format("the {} wheel stalls", f.base.state.stall_left ? "left" : "right"),
               "free the wheel; topoctl drive backs off by hand");
  }
  if (f.base.state.motors_enabled) return good(name, "on");
  if (f.base.control.mode == pipeline::ControlMode::kStanding)
    return good(name, "off; they are switched on with the first command to move");
  return bad(name, "off, and somebody wants to move",
             "press the white MOTORS button on the robot's panel; when they go off again, look at the stop "
             "button and the battery");
}

Check check_bumpers(const DoctorFacts& f) {
  const auto& state = f.base.state;
  if (state.bumpers_front == 0 && state.bumpers_rear == 0) return good("bumpers", "free");
  return bad("bumpers",
             fmt::format("pressed: front {:#04x}, rear {:#04x}", state.bumpers_front, state.bumpers_rear),
             "move the robot away from what it touches by hand");
}

Check permitted_watchdog(const DoctorFacts& f) {
  constexpr int kDaring_ms = 1000;
  Check check = good("firmware watchdog",
                     fmt::format("{} ms{}", *f.watchdog_ms, f.watchdog_given ? " by base.watchdog_ms" : ""));
  if (*f.watchdog_ms > kDaring_ms) {
    check.safer = fmt::format(
        "when the computer dies, the robot runs on for up to {:.1f} m before it brakes, and it keeps as much "
        "more distance all the time; set WatchDog of its FLASH to {} ms or less with ARCOScfg",
        f.configuration.base.v_max_mps * *f.watchdog_ms * 1e-3, kDaring_ms);
  }
  return check;
}

Check check_watchdog(const DoctorFacts& f) {
  const std::string name = "firmware watchdog";
  if (!f.watchdog_ms) return bad(name, "unknown: the robot has not told it yet", "first the check \"base\"");
  if (types::is_watchdog_safe(std::chrono::milliseconds(*f.watchdog_ms))) return permitted_watchdog(f);
  return bad(
      name, *f.watchdog_ms == 0 ? "off or not reported" : fmt::format("{} ms", *f.watchdog_ms),
      fmt::format("set the parameter WatchDog of the robot's FLASH to 1 to {} ms with ARCOScfg: without "
                  "it the robot would run on when the computer dies, so nothing drives",
                  types::kWatchdogMax.count()));
}

Check check_battery(const DoctorFacts& f) {
  if (!f.base.ready) return bad("battery", "unknown: the base is not ready", "first the check \"base\"");
  const types::BaseState& state = f.base.state;
  const std::string found = battery_text(state);
  if (!types::is_battery_low(state.battery_v, state.state_of_charge, f.battery))
    return good("battery", found);
  return bad("battery", found, "charge it; " + battery_limits_text(f.battery));
}

/// Beams that measured nothing: of a model that is not known it is not known either which of its codes mean
/// that nothing is there.
std::string blind_cure(const DoctorFacts& f) {
  const bool guessed = std::any_of(f.devices.begin(), f.devices.end(), [](const DoctorFacts::Device& d) {
    return d.name == "front" && !d.assumed.empty();
  });
  return guessed ? "the front scanner's model is not known, and what it says of its beams ahead is taken for "
                   "failed measurements: bring it where there are walls within its range; if it sees none of "
                   "them, take away what covers its window"
                 : "take away what covers the front scanner's window, and clean it";
}

/// What never changes within the robot's own outline is not in its way: it is a part of it.
Check own_echo(const DoctorFacts& f, const types::Sector& seen) {
  constexpr double kAside_deg = 1.0;  // a beam beside it grazes it
  const double from_deg = seen.from_rad / types::kDegree_rad, to_deg = seen.to_rad / types::kDegree_rad;
  types::Sectors masks = f.configuration.front.masks;
  std::string cure = fmt::format(
      "if it is a part of the robot, mask it: scanner.front.masks_deg with [{:.0f}, {:.0f}]; else look at "
      "the "
      "scanner's place (x_m, y_m, yaw_rad, mirrored) and the hull in the configuration",
      from_deg - kAside_deg, to_deg + kAside_deg);
  if (masks.count < types::Sectors::kMost) {
    masks.all[masks.count++] = {seen.from_rad - kAside_deg * types::kDegree_rad,
                                seen.to_rad + kAside_deg * types::kDegree_rad};
    if (!masks_fault(masks).empty())
      cure =
          "it is in the sector that braking needs, of which too much cannot be masked: mount scanner or post "
          "elsewhere, or look at the scanner's place (x_m, y_m, yaw_rad, mirrored) in the configuration";
  }
  return bad("motion",
             fmt::format("seen inside the robot's own outline at {:.0f} degrees, and it never changes",
                         0.5 * (from_deg + to_deg)),
             std::move(cure));
}

/// The restriction on the base's motion at this moment.
Check check_gate(const DoctorFacts& f) {
  const std::string name = "motion";
  const std::string found(motion::to_text(f.base.control.reason));
  switch (f.base.control.reason) {
    case GateReason::kFree:
    case GateReason::kLimited:
    case GateReason::kSlowed:
      return good(name, found);
    case GateReason::kStaleScan:
      return bad(name, found,
                 "the front scanner's data come late or not at all: see the check \"front\", "
                 "and topoctl latency for a computer that is too busy");
    case GateReason::kBlindScan:
      return bad(name, found, blind_cure(f));
    case GateReason::kBlocked:
      if (f.base.control.own_echo) return own_echo(f, *f.base.control.own_echo);
      return bad(name, found, "something stands too near: move it, or turn away with topoctl drive");
    case GateReason::kStaleStatus:
    case GateReason::kInvalidStatus:
      return bad(name, found, "the robot's status packets do not come: see the check \"base\"");
    case GateReason::kInvalidLimits:
      return bad(name, found, "the limits in the configuration make no sense: topometricd --check-config");
    case GateReason::kNoWatchdog:
      return bad(name, found, "see the check \"firmware watchdog\"");
    case GateReason::kStall:
      return bad(name, found, "see the check \"motors\"");
    case GateReason::kBumper:
      return bad(name, found, "see the check \"bumpers\"");
    case GateReason::kPlaceProposed:
    case GateReason::kPlaceDropped:
      return bad(name, found, "see the check \"session\"");
    case GateReason::kImplausible:
      return bad(name, found, "see the check \"agreement\"");
    case GateReason::kEmergencyStop:
      // The base reports once per period: a report from before the clear is out of date.
      if (!f.estop_latched) return good(name, "the emergency stop was cleared a moment ago");
      return bad(name, found, "see the check \"e-stop\"");
    default:
      return good(name, found);
  }
}

/// What is commanded, measured and seen (core/plausibility).
std::vector<Check> check_agreement(const DoctorFacts& f) {
  const std::string name = "agreement";
  const plausibility::Opinion& opinion = f.base.control.plausibility;
  std::vector<Check> checks;
  for (std::size_t i = 0; i < plausibility::kDoubts; ++i) {
    const plausibility::DoubtText& text = plausibility::doubt_texts()[i];
    if (opinion.doubts.test(i)) checks.push_back(bad(name, std::string(text.found), std::string(text.cure)));
  }
  if (!checks.empty()) return checks;
  Check check = good(name, fmt::format("commands, reports and scans agree; wheels answer after {:.2f} s",
                                       types::to_seconds(opinion.lag)));
  constexpr double kWeak = 0.8;
  const double believed_mps2 = f.configuration.base.deceleration_mps2;
  if (opinion.deceleration_mps2 > 0.0 && opinion.deceleration_mps2 < kWeak * believed_mps2) {
    check.safer = fmt::format(
        "the robot was measured to brake with {:.2f} m/s2, and its distance is kept for {:.2f}: it stops "
        "later than planned; look at the load and the floor, and set base.deceleration_mps2 to {:.2f}",
        opinion.deceleration_mps2, believed_mps2, opinion.deceleration_mps2);
  }
  checks.push_back(std::move(check));
  return checks;
}

Check check_mapping(const DoctorFacts& f) {
  const std::uint64_t all = f.scans_lost_lately + f.scans_matched_lately;
  const std::string found = fmt::format("{} of the last {} scans matched nothing", f.scans_lost_lately, all);
  if (2 * f.scans_lost_lately > all) {
    return bad("mapping", found,
               "the robot does not know where it is: it was carried, or stands in the open. Bring it back to "
               "where it was, or start the daemon anew for a new map");
  }
  if (!f.has_map)
    return bad("mapping", "no scan was matched since the start", "first the checks \"base\" and \"front\"");
  Check check = good("mapping", f.map_doubt.empty() ? found : f.map_doubt);
  if (!f.map_doubt.empty()) {
    check.safer =
        "an exploration looks at doubted regions again (topoctl status names the places) and ends where it "
        "began; by hand, drive back to what was mapped before, or begin a map anew (topoctl session new)";
  }
  return check;
}

Check check_threads(const DoctorFacts& f) {
  if (f.stuck.empty()) return good("threads", "all advance");
  return bad("threads", fmt::format("{} does not advance", fmt::join(f.stuck, ", ")),
             "start the service again (systemctl restart topometric) and keep its log");
}

Check check_real_time(const DoctorFacts& f) {
  if (f.policy == RealtimePolicy::kOff) {
    Check check = good("real time", "not asked for (realtime.policy = \"off\")");
    check.safer =
        "other programs may delay the thread that brakes; realtime.policy = \"try\", or \"enforce\" on a "
        "robot";
    return check;
  }
  if (f.refusals.empty()) return good("real time", "granted");
  return bad("real time", fmt::format("{}", fmt::join(f.refusals, "; ")),
             "start it as the service, whose unit grants them (LimitRTPRIO=50, LimitMEMLOCK=infinity), or "
             "set realtime.policy = \"off\" on a machine that needs none");
}

/// The cure for a session in which the robot's place is not known.
std::string session_cure(types::PlaceStanding place) {
  const std::string anew =
      "topoctl session new takes a map made since the start: its origin is where the robot was then, and the "
      "areas of the configuration count from there";
  if (place == types::PlaceStanding::kProposed) {
    return "when the robot is where it is proposed: topoctl session confirm; where it is elsewhere: topoctl "
           "session confirm --pose X Y THETA; " +
           anew;
  }
  if (place == types::PlaceStanding::kDropped) {
    return "it was carried to a place that looks alike, or the building has changed: topoctl session confirm "
           "--pose X Y THETA says where the robot is; " +
           anew;
  }
  return "topoctl session load NAME --pose X Y THETA goes on with a session (topoctl session list names "
         "them), "
         "topoctl session confirm --pose X Y THETA with the one to go on with; " +
         anew;
}

Check check_session(const DoctorFacts& f) {
  const std::string name = "session";
  if (!f.session_obstacle.empty()) return bad(name, f.session_obstacle, session_cure(f.place));
  if (f.sessions.empty()) {
    Check check = good(name, "none is kept");
    check.safer =
        "the map ends with the daemon, and a mission with it when the daemon is killed; session.folder = "
        "\"/var/lib/topometric\" with session.journal = true";
    return check;
  }
  if (!f.journal.failing) return good(name, "kept in " + f.sessions);
  const std::string message = f.journal.message.str();
  return bad(name, fmt::format("not being kept in {}: {}", f.sessions, message),
             mentions(message, ENOSPC)
                 ? "make room there: delete old maps, sessions and recordings; what is not "
                   "written yet comes then, unless the daemon ends before"
                 : "see that it is a folder that the daemon's user may write to");
}

Check check_team(const DoctorFacts::Team& team) {
  const std::string name = "team";
  if (team.trouble.empty()) {
    Check check = good(name, team.found);
    check.safer = team.warning;
    return check;
  }
  return bad(name, team.trouble,
             "the robot goes on alone, but for a number that two have; topoctl team shows more, and so does "
             "the log of topometric-link");
}

constexpr std::uint64_t kEnoughBytes = 200ULL << 20U;

Check check_disks(const DoctorFacts& f) {
  const std::string name = "disk";
  if (f.disks.empty()) return good(name, "nothing is saved by itself");
  std::string found;
  for (const auto& [folder, free_bytes] : f.disks) {
    if (!free_bytes) {
      return bad(name, fmt::format("{} cannot be used", folder),
                 "make the folder, and let the daemon's user write to it");
    }
    found += fmt::format("{}{} MiB free for {}", found.empty() ? "" : ", ", *free_bytes >> 20U, folder);
  }
  const bool enough = std::all_of(f.disks.begin(), f.disks.end(),
                                  [](const auto& disk) { return *disk.free_bytes >= kEnoughBytes; });
  return enough ? good(name, found) : bad(name, found, "make room: delete old maps and recordings");
}

}  // namespace

std::vector<Check> examine(const DoctorFacts& facts) {
  std::vector<Check> checks;
  for (const auto& device : facts.devices) checks.push_back(check_device(device));
  if (facts.can) checks.push_back(check_can(*facts.can));
  checks.push_back(check_watchdog(facts));
  checks.push_back(check_estop(facts));
  checks.push_back(check_motors(facts));
  checks.push_back(check_bumpers(facts));
  checks.push_back(check_battery(facts));
  checks.push_back(check_gate(facts));
  std::ranges::move(check_agreement(facts), std::back_inserter(checks));
  checks.push_back(check_mapping(facts));
  checks.push_back(check_threads(facts));
  checks.push_back(check_real_time(facts));
  checks.push_back(check_session(facts));
  checks.push_back(check_disks(facts));
  if (facts.team) checks.push_back(check_team(*facts.team));
  std::ranges::move(examine_choices(facts.configuration), std::back_inserter(checks));
  return checks;
}

}  // namespace topo::daemon

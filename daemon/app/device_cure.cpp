// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/device_cure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

namespace topo::daemon {
namespace {

bool says(const std::string& message, std::string_view words) {
  return message.find(words) != std::string::npos;
}
bool says_error(const std::string& message, int error) { return says(message, std::strerror(error)); }

/// States with one cure each, whatever the device.
struct StateCure {
  std::string_view state, cure;
};
constexpr std::array kCures{
    StateCure{"connecting", "wait a few seconds: it answers, and is being asked who it is"},
    StateCure{
        "reset",
        "wait: the connection is made again by itself; if the controller resets again and again, look at "
        "the battery and at its supply"},
    StateCure{"refuses",
              "switch the robot off and on: its controller answers and does not take up a connection"},
    StateCure{"unidentified",
              "look at the line to the robot; without base.serial_number any robot at this address is taken, "
              "which base.name still tells apart"},
    StateCure{
        "on trial",
        "with room to turn: topoctl drive 0 0.2 --for 5; the robot must stop by itself while nothing is "
        "sent to it, and is ready then"},
    StateCure{
        "late",
        "use a faster line, or fewer data (skip_scans, intensity = false); it ends by itself when a clock "
        "was set"},
    StateCure{
        "damaged",
        "what it says arrives damaged: look at plugs and cable, and lay it away from the motors' cables; "
        "on USB try another socket without a hub between"},
    StateCure{"unusable",
              "nothing is wrong with the scanner itself: its parameters are none that this program can work "
              "with (see what was found and expected); use another model"},
};

std::string address_key(const DoctorFacts::Device& d) {
  return d.name == "base" ? "base.address" : fmt::format("scanner.{}.address", d.name);
}

std::string fault_cure(const DoctorFacts::Device& d) {
  if (says(d.message, "to check an error")) {
    return "wait: the sensor checks itself and goes on by itself; if it stays so, switch its power off and "
           "on";
  }
  return "the sensor reports a fault of its own: switch it off and on; if it stays, it has to be repaired";
}

std::string silent_cure(const DoctorFacts::Device& d) {
  if (says(d.message, "it was rebooted")) return "wait 10 s: it was rebooted, and boots";
  if (says(d.message, "no scan for") || says(d.message, "no status from the robot")) {
    return "it was there and is not heard any more: look at its cable and its power; the connection is made "
           "again by itself";
  }
  if (says(d.message, "stopped answering")) {
    return "it answered and then fell silent: look at its cable and its power, and at what else may hold the "
           "port";
  }
  return "the port is there and nothing comes: switch the device on, look at its cable, and at "
         "what else may hold the port";
}

std::string disconnected_cure(const DoctorFacts::Device& d) {
  const std::string key = address_key(d);
  if (says_error(d.message, EACCES)) {
    return fmt::format(
        "the daemon's user may not open {}: add it to the group that owns the device "
        "(usermod -aG dialout topometric) and start the service again",
        d.address);
  }
  if (says_error(d.message, ENOENT)) {
    return fmt::format(
        "there is no {}: plug the device in and switch it on (ls -l /dev/serial/by-id shows "
        "what is there), or mend {}",
        d.address, key);
  }
  if (says_error(d.message, EBUSY) || says(d.message, "another program"))
    return fmt::format("another program holds {} (fuser shows which): end it", d.address);
  if (says(d.message, "was exchanged"))
    return "wait: it connects to the other device; if it is not meant to be there, exchange the plugs";
  if (says_error(d.message, ECONNREFUSED)) {
    return fmt::format(
        "its computer is there and nothing listens at {}: a device that was just switched on boots for some "
        "10 s; else look for another program that is connected to it, or mend {}",
        d.address, key);
  }
  return fmt::format(
      "nothing answers at {}: switch the device on, look at cable and network (ping its "
      "host), or mend {}",
      d.address, key);
}

std::string unsafe_cure(const DoctorFacts::Device& d) {
  if (says(d.message, "did not obey"))
    return "press the robot's stop button or reset its controller; or, while it stands, topoctl clear-estop";
  return "see the check \"firmware watchdog\"";
}

}  // namespace

std::string device_cure(const DoctorFacts::Device& d) {
  if (d.state.empty() || d.state == "starting")
    return "wait: it is starting, which takes some 10 s after it was switched on; if it stays so, see the "
           "log";
  const auto fixed =
      std::find_if(kCures.begin(), kCures.end(), [&](const StateCure& c) { return c.state == d.state; });
  if (fixed != kCures.end()) return std::string(fixed->cure);
  if (d.state == "wrong device") {
    if (says(d.message, "base.family"))
      return "if its board is like one of those named, write which: base.family; else it is no robot for "
             "this "
             "program";
    return fmt::format(
        "another device answers at {} than the configured one: exchange the plugs, or mend {} "
        "and the model, name or serial number that is expected there",
        d.address, address_key(d));
  }
  if (d.state == "unsafe") return unsafe_cure(d);
  if (d.state == "fault") return fault_cure(d);
  if (d.address.starts_with("can:")) return "see the check \"can\"; if that is good, switch the robot on";
  return d.state == "silent" ? silent_cure(d) : disconnected_cure(d);
}

}  // namespace topo::daemon

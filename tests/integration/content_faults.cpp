// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/content_faults.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <ostream>

#include "tests/integration/process_faults.hpp"

namespace topo::test {
namespace {

constexpr double kNever = -1.0;
constexpr double kPressed_s = 1e6;

Json command(Json json, const char* name) {
  json["command"] = name;
  return json;
}

using Faults = std::vector<ContentFault>;

ContentFault fault(std::string name, std::vector<Json> strike, std::vector<Json> lift, std::string says = "",
                   double box_after_s = 1.5) {
  ContentFault made;
  made.name = std::move(name);
  made.strike = std::move(strike);
  made.lift = std::move(lift);
  made.says = std::move(says);
  made.box_after_s = box_after_s;
  return made;
}

/// What a line can do to the front scanner's data, and the scanner itself.
Faults front_content() {
  const auto on = [](const char* name, Json json) {
    json["device"] = "front";
    return command(std::move(json), name);
  };
  const Json prompt = on("delay", {{"seconds", 0.0}});
  const Json unmasked = on("empty", {{"on", false}});
  const char* const late = "data wait on their line";
  return {
      fault("front: scans 0.35 s late", {on("delay", {{"seconds", 0.35}})}, {prompt}, "front"),
      fault("front: scans 2 s late", {on("delay", {{"seconds", 2.0}})}, {prompt}, "front"),
      fault("front: scans late by 50 ms more every second",
            {on("delay", {{"seconds", 0.0}, {"grows_s_per_s", 0.05}})}, {prompt}, late, 8.5),
      fault("front: scans late by 80 ms more every second",
            {on("delay", {{"seconds", 0.0}, {"grows_s_per_s", 0.08}})}, {prompt}, late, 6.0),
      fault("front: line a few per cent too slow", {on("slow", {{"bytes_per_s", 125'000.0}})},
            {on("slow", {{"bytes_per_s", 0.0}})}, "", 6.0),
      fault("front: requests to it 1 s late", {on("delay", {{"seconds", 1.0}, {"way", "to"}})},
            {on("delay", {{"seconds", 0.0}, {"way", "to"}})}),
      fault("front: repeats one picture", {on("freeze", Json::object())}, {on("freeze", {{"on", false}})},
            "repeats one picture"),
      fault("front: sees nothing", {on("empty", Json::object())}, {unmasked}, "reports nothing"),
      fault("front: sees nothing ahead", {on("empty", {{"from_deg", -90}, {"to_deg", 90}})}, {unmasked},
            "reports nothing"),
      fault("front: half of the forward sector sees nothing",
            {on("empty", {{"from_deg", 1}, {"to_deg", 60}})}, {unmasked}),
      fault("front: half of the forward sector covered", {on("cover", {{"from_deg", 0}, {"to_deg", 60}})},
            {unmasked}, "lies on the front scanner"),
      fault("front: another's steps in mid-stream", {on("steps", {{"start", 270}, {"end", 810}})},
            {on("reset", Json::object())}),
      fault("front: coronal scanner in its place", {command(Json::object(), "swap")},
            {command(Json::object(), "swap")}, "", 3.0),
      fault("front: another sensor in its place", {on("replace", Json::object())},
            {on("replace", {{"foreign", false}})}, "front"),
      fault("front: another serial number, after a cut",
            {on("foreign", Json::object()), on("cut", {{"seconds", 0.5}})},
            {on("foreign", {{"on", false}}), on("cut", {{"seconds", 0.5}})}, "front"),
      fault("front: every scan comes three times", {on("repeat", {{"copies", 3}})},
            {on("repeat", {{"copies", 1}})}),
      fault("front: with each scan the one of 1 s before", {on("replay", {{"back", 40}})},
            {on("replay", {{"back", 0}})}),
  };
}

Faults coronal_content() {
  const auto on = [](const char* name, Json json) {
    json["device"] = "coronal";
    return command(std::move(json), name);
  };
  return {
      fault("coronal: scans late by 80 ms more every second",
            {on("delay", {{"seconds", 0.0}, {"grows_s_per_s", 0.08}})}, {on("delay", {{"seconds", 0.0}})}),
      fault("coronal: repeats one picture", {on("freeze", Json::object())}, {on("freeze", {{"on", false}})}),
      fault("coronal: sees nothing", {on("empty", Json::object())}, {on("empty", {{"on", false}})}),
      fault("coronal: another sensor in its place", {on("replace", Json::object())},
            {on("replace", {{"foreign", false}})}, "coronal"),
  };
}

Faults base_lines() {
  const auto on = [](const char* name, Json json) {
    json["device"] = "base";
    return command(std::move(json), name);
  };
  const Json prompt = on("delay", {{"seconds", 0.0}});
  const Json heard = on("delay", {{"seconds", 0.0}, {"way", "to"}});
  return {
      // Whichever is known first: that none is fresh, that they wait, or that the wheels seem to follow late.
      fault("base: statuses 0.35 s late", {on("delay", {{"seconds", 0.35}})}, {prompt},
            "stopped|silent|wait on their line|follow the commands too late"),
      fault("base: statuses late by 50 ms more every second",
            {on("delay", {{"seconds", 0.0}, {"grows_s_per_s", 0.05}})}, {prompt},
            "wait on their line|follow the commands too late", 8.5),
      fault("base: commands 0.6 s late", {on("delay", {{"seconds", 0.6}, {"way", "to"}})}, {heard},
            "follow the commands too late", 3.5),
      fault("base: commands 1.5 s late", {on("delay", {{"seconds", 1.5}, {"way", "to"}})}, {heard}, "", 4.5),
      fault("base: commands late by 80 ms more every second",
            {on("delay", {{"seconds", 0.0}, {"grows_s_per_s", 0.08}, {"way", "to"}})}, {heard}, "", 7.0),
      fault("base: one command in three gets lost", {command({{"rate", 0.33}}, "lose")},
            {command({{"rate", 0.0}}, "lose")}),
      fault("base: every packet comes twice", {on("repeat", {{"copies", 2}})},
            {on("repeat", {{"copies", 1}})}),
      fault("base: with each packet the one of 1 s before", {on("replay", {{"back", 10}})},
            {on("replay", {{"back", 0}})}),
      fault("base: another robot's base, after a cut",
            {on("foreign", Json::object()), on("cut", {{"seconds", 0.5}})},
            {on("foreign", {{"on", false}}), on("cut", {{"seconds", 0.5}})}, "serial", kNever),
      fault("base: another controller in its place", {on("replace", Json::object())},
            {on("replace", {{"foreign", false}})}, "serial", kNever),
      fault("base: its watchdog is off after a cut",
            {command({{"ms", 0}}, "watchdog"), on("cut", {{"seconds", 0.5}})},
            {command({{"ms", 2000}}, "watchdog"), on("cut", {{"seconds", 0.5}})}, "watchdog", kNever),
  };
}

Faults base_content() {
  const auto lie = [](const char* field, double value) {
    return command({{"field", field}, {"value", value}}, "lie");
  };
  const Json honest = command({{"field", "none"}}, "lie");
  const auto encoder = [](const char* side, bool dead) {
    return command({{"side", side}, {"dead", dead}}, "encoder");
  };
  const auto sonar = [](double range_m) { return command({{"range_m", range_m}}, "sonar"); };
  const Json free_sonar = command({{"stuck", false}}, "sonar");
  const char* const impossible = "its model cannot make";
  Faults faults{
      fault("base: swallows every command", {command(Json::object(), "disobey")},
            {command({{"on", false}}, "disobey")}, "moves otherwise than commanded", kNever),
      fault("base: impossible speed", {lie("speed", -6.1)}, {honest}, impossible),
      fault("base: says that it stands", {lie("speed", 0.0)}, {honest}, ""),
      fault("base: impossible turning", {lie("turning", 9.0)}, {honest}, impossible),
      fault("base: pose jumps", {lie("position", 1.5)}, {honest},
            "its model cannot make|measure different motions"),
      fault("base: heading jumps", {lie("heading", 1.5)}, {honest}, impossible),
      fault("base: the left encoder is dead", {encoder("left", true)}, {encoder("left", false)}, ""),
      fault("base: the right encoder is dead", {encoder("right", true)}, {encoder("right", false)}, ""),
      fault("base: motors off by the button", {command(Json::object(), "motors-off")}, {},
            "motors were switched off", kNever),
      fault("base: wheels stuck for 2 s", {command({{"seconds", 2.0}}, "stall")}, {}, "stall", kNever),
      fault("base: front bumper stuck", {command({{"front", 4}, {"seconds", kPressed_s}}, "bumper")},
            {command({{"seconds", 0.0}}, "bumper")}, "bumper", kNever),
      fault("base: sonar reads 0", {sonar(0.0)}, {free_sonar}, ""),
      fault("base: sonar reads no echo", {sonar(5.0)}, {free_sonar}, ""),
      fault("base: the battery falls by 1 V/s",
            {command({{"volts", 12.7}, {"falls_v_per_s", 1.0}}, "battery")},
            {command({{"volts", 12.7}}, "battery")}, "", 6.0),
      fault("all: USB gone and back at once", {command({{"seconds", 2.0}}, "unplug")}, {}, "", kNever),
      fault("robot: carried while it drives", {command({{"x_m", 4.0}, {"y_m", 5.5}}, "carry")}, {}, "", 3.0),
  };
  faults[0].order = "stop";
  faults[11].sonar_only = faults[12].sonar_only = true;
  return faults;
}

Faults half_open() {
  Faults faults;
  for (const char* device : {"front", "coronal", "base"}) {
    faults.push_back(fault(std::string(device) + ": half-open TCP",
                           {command({{"device", device}}, "half-open")}, {}, device, kNever));
    faults.back().tcp_only = true;
  }
  faults[1].box_after_s = 1.5;
  return faults;
}

ContentFault hung_threads(const std::string& name, const std::vector<std::string>& threads,
                          double box_after_s) {
  ContentFault made = fault(name, {}, {}, "", box_after_s);
  made.act = [threads](WireRig&) {
    EXPECT_GE(HungThreads::hang(threads), std::max<std::size_t>(1, threads.size()));
  };
  made.undo = [](WireRig&) { HungThreads::release(); };
  return made;
}

/// It finds itself where its path ended, or says that it does not know: either way it stands.
ContentFault killed_and_carried() {
  ContentFault made =
      fault("daemon: killed, the robot carried to a place that looks alike", {}, {}, "", kNever);
  made.journal = made.process = true;
  const auto was = std::make_shared<types::Se2>();
  const auto carry = [](const types::Se2& to) {
    return command({{"x_m", to.x_m}, {"y_m", to.y_m}, {"theta_rad", to.theta_rad}}, "carry");
  };
  made.act = [was, carry](WireRig& rig) {
    rig.kill_daemon([&] {
      constexpr double kLength_m = 30.0, kWidth_m = 8.0;  // of the hall, which is the same from both ends
      *was = rig.moment().truth.pose;
      const double turned_rad = std::remainder(was->theta_rad + std::acos(-1.0), 2.0 * std::acos(-1.0));
      rig.strike({carry({kLength_m - was->x_m, kWidth_m - was->y_m, turned_rad})});
    });
  };
  made.undo = [was, carry](WireRig& rig) { rig.strike({carry(*was)}); };
  return made;
}

Faults of_the_machine() {
  Faults faults{
      hung_threads("daemon: all threads hung (SIGSTOP)", {}, kNever),
      hung_threads("daemon: thread base hung", {"base"}, kNever),
      hung_threads("daemon: thread front hung", {"front"}, kNever),
      hung_threads("daemon: thread coronal hung", {"coronal"}, 1.5),
      hung_threads("daemon: thread mapping hung", {"mapping"}, 1.5),
      hung_threads("daemon: thread closure hung", {"closure"}, 1.5),
      hung_threads("daemon: thread planning hung", {"planning"}, 1.5),
      hung_threads("daemon: thread journal hung", {"journal"}, 1.5),
      hung_threads("daemon: thread main hung", {"daemon-main"}, 1.5),
  };
  faults[0].deaf = faults[8].deaf = true;
  faults[7].journal = true;
  ContentFault hog = fault("machine: four threads that never wait", {}, {}, "", 1.5);
  const auto hogs = std::make_shared<std::unique_ptr<CpuHog>>();
  static constexpr unsigned kHogs = 4;
  hog.act = [hogs](WireRig&) { *hogs = std::make_unique<CpuHog>(kHogs); };
  hog.undo = [hogs](WireRig&) { hogs->reset(); };
  faults.push_back(hog);
  ContentFault full = fault("machine: disk full", {}, {}, "", 1.5);
  full.journal = true;
  full.act = [](WireRig&) { set_disk_full(true); };
  full.undo = [](WireRig&) { set_disk_full(false); };
  faults.push_back(full);
  faults.push_back(killed_and_carried());
  return faults;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const ContentFault& f) { return out << f.name; }

std::vector<ContentFault> content_faults() {
  Faults all;
  for (auto part : {front_content, coronal_content, base_lines, base_content, half_open, of_the_machine})
    for (ContentFault& one : part()) all.push_back(std::move(one));
  return all;
}

std::vector<Elsewhere> faults_elsewhere() {
  return {{"machine: CAN at full load", "tests/vm/can_test.py --figures (an emulated guest with a bus)"}};
}

}  // namespace topo::test

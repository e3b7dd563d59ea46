// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/doctor.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace topo::daemon {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A robot that nothing is wrong with.
DoctorFacts healthy() {
  DoctorFacts facts;
  facts.devices = {{"base", "/dev/ttyUSB0", "ready", "", true}, {"front", "tcp:h:1", "streaming", "", true}};
  facts.base.ready = true;
  facts.base.control.reason = motion::GateReason::kFree;
  facts.base.state.battery_v = 12.6F;
  facts.watchdog_ms = 1000;
  facts.battery = {11.6, 0.2};
  facts.has_map = true;
  facts.scans_matched_lately = 100;
  facts.disks = {{"/maps", 1ULL << 30U}, {"/sessions", 1ULL << 30U}};
  facts.sessions = "/sessions";
  facts.policy = RealtimePolicy::kTry;
  Configuration& c = facts.configuration;
  c.front.present = c.coronal.present = true;
  c.base.serial_number = "SB0123";
  c.front.serial_number = "H0902680";
  c.coronal.serial_number = "H0902681";
  return facts;
}

/// The only bad finding.
Check the_bad_one(const DoctorFacts& facts) {
  std::vector<Check> bad;
  for (const Check& check : examine(facts)) {
    EXPECT_EQ(check.ok, check.cure.empty()) << check.name;
    if (!check.ok) bad.push_back(check);
  }
  EXPECT_EQ(bad.size(), 1U);
  return bad.empty() ? Check{} : bad.front();
}

TEST(Doctor, FindsNothingWrongWithAHealthyRobot) {
  for (const Check& check : examine(healthy())) {
    EXPECT_TRUE(check.ok) << check.name << ": " << check.found;
    EXPECT_THAT(check.cure, IsEmpty()) << check.name;
    EXPECT_THAT(check.safer, IsEmpty()) << check.name;
  }
}

/// The only warning; nothing is bad.
Check the_warning(const DoctorFacts& facts) {
  std::vector<Check> warnings;
  for (const Check& check : examine(facts)) {
    EXPECT_TRUE(check.ok) << check.name << ": " << check.found;
    EXPECT_THAT(check.cure, IsEmpty()) << check.name;
    if (!check.safer.empty()) warnings.push_back(check);
  }
  EXPECT_EQ(warnings.size(), 1U);
  return warnings.empty() ? Check{} : warnings.front();
}

TEST(Doctor, WarnsOfWhatIsDaringAndDoesNotCallItBad) {
  struct Row {
    std::string_view name, found, safer;
    void (*make)(DoctorFacts&);
  };
  const std::vector<Row> rows{
      {"sonar", "off", "base.sonar = true", [](DoctorFacts& f) { f.configuration.base.sonar = false; }},
      {"margin", "0.02 m", "motion.margin_m = 0.05 or more",
       [](DoctorFacts& f) { f.configuration.motion.margin_m = 0.02; }},
      {"stamps", "front: 0.05 s", "50 ms younger than the sensor says, at full speed 0.035 m",
       [](DoctorFacts& f) { f.configuration.front.stamp_offset_s = 0.05; }},
      {"stamps", "coronal: -0.01 s", "10 ms older",
       [](DoctorFacts& f) { f.configuration.coronal.stamp_offset_s = -0.01; }},
      {"serial numbers", "base.serial_number not set", "topoctl status --json",
       [](DoctorFacts& f) { f.configuration.base.serial_number.clear(); }},
      {"serial numbers", "scanner.front.serial_number, scanner.coronal.serial_number not set", "exchanged",
       [](DoctorFacts& f) {
         f.configuration.front.serial_number.clear();
         f.configuration.coronal.serial_number.clear();
       }},
      {"session", "none is kept", "session.journal = true", [](DoctorFacts& f) { f.sessions.clear(); }},
      {"team", "office: 1 other robot in reach", "handshakes",
       [](DoctorFacts& f) {
         f.team = {"", "4 handshakes were refused", "office: 1 other robot in reach"};
       }},
      {"real time", "not asked for", "\"enforce\"", [](DoctorFacts& f) { f.policy = RealtimePolicy::kOff; }},
      {"firmware watchdog", "2000 ms", "up to 1.4 m before it brakes",
       [](DoctorFacts& f) { f.watchdog_ms = 2000; }},
      {"base", "ready", "\"p3dx-sh-lms1xx\" is driven as p3dx-sh; drive 2 m and a turn by hand",
       [](DoctorFacts& f) { f.devices[0].assumed = "\"p3dx-sh-lms1xx\" is driven as p3dx-sh"; }},
      {"masks", "front: [[40.0", "no wider than the robot's own posts",
       [](DoctorFacts& f) {
         f.configuration.front.masks.count = 1;
         f.configuration.front.masks.all[0] = {40.0 * types::kDegree_rad, 44.0 * types::kDegree_rad};
       }},
      {"speed", "at most 0.8 m/s", "0.64 m (0.49 m at 0.7 m/s)",
       [](DoctorFacts& f) { f.configuration.base.v_max_mps = 0.8; }},
      {"team security", "off", "who is in reach of wlan0 can read, disturb and command the team",
       [](DoctorFacts& f) {
         f.configuration.team.present = true;
         f.configuration.team.interface = "wlan0";
         f.configuration.team.security = "off";
       }},
  };
  for (const Row& row : rows) {
    DoctorFacts facts = healthy();
    row.make(facts);
    const Check check = the_warning(facts);
    EXPECT_EQ(check.name, row.name);
    EXPECT_THAT(check.found, HasSubstr(row.found)) << row.name;
    EXPECT_THAT(check.safer, HasSubstr(row.safer)) << row.name;
  }
}

TEST(Doctor, ATeamWithCredentialsIsNoWarning) {
  DoctorFacts facts = healthy();
  facts.configuration.team.present = true;
  facts.configuration.team.security = "/etc/topometric/team";
  for (const Check& check : examine(facts)) EXPECT_THAT(check.safer, IsEmpty()) << check.name;
}

TEST(Doctor, TheEdgeOfWhatIsDaring) {
  DoctorFacts facts = healthy();
  facts.watchdog_ms = 1000;
  facts.configuration.motion.margin_m = 0.03;
  facts.configuration.base.v_max_mps = 0.7;
  facts.configuration.coronal = {};  // without a coronal scanner, nothing is said of it
  facts.configuration.coronal.stamp_offset_s = 0.05;
  for (const Check& check : examine(facts)) EXPECT_THAT(check.safer, IsEmpty()) << check.name;
  facts.watchdog_ms = 1001;
  EXPECT_EQ(the_warning(facts).name, "firmware watchdog");
}

TEST(Doctor, ASessionThatCannotBeGoneOnWith) {
  DoctorFacts facts = healthy();
  facts.session_obstacle = "the session to go on with cannot be used: damaged";
  const Check check = the_bad_one(facts);
  EXPECT_EQ(check.name, "session");
  EXPECT_EQ(check.found, facts.session_obstacle);
  EXPECT_THAT(check.cure, HasSubstr("topoctl session new"));
}

TEST(Doctor, APlaceThatWaitsForTheOperatorHasItsCure) {
  DoctorFacts facts = healthy();
  facts.session_obstacle = "where the robot is in session office is a proposal";
  facts.place = types::PlaceStanding::kProposed;
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("topoctl session confirm; where it is elsewhere"));
  facts.place = types::PlaceStanding::kDropped;
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("carried to a place that looks alike"));
  facts.session_obstacle.clear();
  facts.place = types::PlaceStanding::kKnown;
  for (const auto reason : {motion::GateReason::kPlaceProposed, motion::GateReason::kPlaceDropped}) {
    facts.base.control.reason = reason;
    EXPECT_EQ(the_bad_one(facts).name, "motion");
    EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("session"));
  }
}

TEST(Doctor, ASessionThatIsNotBeingKept) {
  DoctorFacts facts = healthy();
  facts.journal.failing = true;
  facts.journal.message = std::string("journal-1.session: cannot write 9 bytes: ") + std::strerror(ENOSPC);
  const Check full = the_bad_one(facts);
  EXPECT_EQ(full.name, "session");
  EXPECT_THAT(full.found, HasSubstr("/sessions: journal-1.session: cannot write 9 bytes: No space left"));
  EXPECT_THAT(full.cure, HasSubstr("make room"));
  facts.journal.message = std::string("/sessions: ") + std::strerror(ENOTDIR);
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("a folder"));
}

DoctorFacts healthy_on_can() {
  DoctorFacts facts = healthy();
  facts.can.emplace().name = "can0";
  io::CanInterface& can = facts.can->interface;
  can.exists = can.is_can = can.up = true;
  return facts;
}

TEST(Doctor, TheBusOfABaseOnCan) {
  DoctorFacts facts = healthy_on_can();
  io::CanInterface& can = facts.can->interface;
  can.queue_length = 128;
  for (const Check& check : examine(facts)) EXPECT_TRUE(check.ok) << check.found;
  can.state = io::CanState::kActive;
  can.bit_rate_bps = 500'000;
  for (const Check& check : examine(facts)) EXPECT_TRUE(check.ok) << check.found;
  can.up = false;
  const Check down = the_bad_one(facts);
  EXPECT_EQ(down.name, "can");
  EXPECT_THAT(down.found, HasSubstr("switched off"));
  EXPECT_THAT(down.cure, HasSubstr("ip link set can0"));
}

TEST(Doctor, WhatWentWrongOnTheBusLately) {
  DoctorFacts facts = healthy_on_can();
  auto& can = *facts.can;
  can.faults_lately[io::BusFault::kInterrupted] = 5;  // stops are no fault
  for (const Check& check : examine(facts)) EXPECT_TRUE(check.ok) << check.found;
  can.faults_lately[io::BusFault::kPassive] = 3;
  can.faults_lately[io::BusFault::kDropped] = 40;
  const Check check = the_bad_one(facts);
  EXPECT_EQ(check.name, "can");
  EXPECT_THAT(check.found, HasSubstr("40 x a frame dropped"));
  EXPECT_THAT(check.found, HasSubstr("3 x error passive: most frames fail"));
  EXPECT_THAT(check.cure, HasSubstr("CAN-H and CAN-L"));
}

TEST(Doctor, AKernelThatDoesNotTellOfTheBusIsReported) {
  DoctorFacts facts = healthy();
  facts.can.emplace().name = "can0";
  facts.can->unknown = "can0: asking the kernel: Operation not permitted";
  const Check check = the_bad_one(facts);
  EXPECT_EQ(check.name, "can");
  EXPECT_THAT(check.found, HasSubstr("asking the kernel"));
  EXPECT_THAT(check.cure, HasSubstr("AF_NETLINK"));
}

TEST(Doctor, ASilentBaseOnCanIsNoSerialPort) {
  DoctorFacts facts = healthy();
  auto& base = facts.devices.front();
  base = {"base", "can:can0:0", "silent", "no status", false};
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("see the check \"can\""));
  base.address = "serial:/dev/ttyUSB0";
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("cable"));
}

TEST(Doctor, DevicesByTheirStateAndTheSystemsWords) {
  DoctorFacts facts = healthy();
  auto& device = facts.devices[1];
  device.working = false;
  const auto cure = [&](const std::string& state, const std::string& message) {
    device.state = state;
    device.message = message;
    const Check check = the_bad_one(facts);
    EXPECT_EQ(check.name, "front");
    return check.cure;
  };
  EXPECT_THAT(cure("disconnected", std::strerror(EACCES)), HasSubstr("usermod -aG dialout"));
  EXPECT_THAT(cure("disconnected", std::strerror(ENOENT)), HasSubstr("plug the device in"));
  EXPECT_THAT(cure("disconnected", "another program holds the device"), HasSubstr("end it"));
  EXPECT_THAT(cure("disconnected", std::strerror(ECONNREFUSED)), HasSubstr("scanner.front.address"));
  EXPECT_THAT(cure("wrong device", "found a base"), HasSubstr("exchange the plugs"));
  EXPECT_THAT(cure("silent", ""), HasSubstr("switch the device on"));
  EXPECT_THAT(cure("starting", ""), HasSubstr("wait"));
  EXPECT_THAT(cure("damaged", ""), HasSubstr("cable"));
  EXPECT_THAT(cure("unusable", ""), HasSubstr("nothing is wrong with the scanner"));
  EXPECT_THAT(cure("fault", ""), HasSubstr("repaired"));
}

TEST(Doctor, FirmwareWatchdog) {
  DoctorFacts facts = healthy();
  facts.watchdog_ms = 0;
  EXPECT_THAT(the_bad_one(facts).cure, AllOf(HasSubstr("1 to 2000 ms"), HasSubstr("ARCOScfg")));
  facts.watchdog_ms = 2001;
  EXPECT_EQ(the_bad_one(facts).found, "2001 ms");
  facts.watchdog_ms.reset();
  EXPECT_EQ(the_bad_one(facts).name, "firmware watchdog");
}

TEST(Doctor, BlindBeamsOfAnUnknownModelAreNotADirtyWindow) {
  DoctorFacts facts = healthy();
  facts.base.control.reason = motion::GateReason::kBlindScan;
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("clean it"));
  facts.devices[1].assumed = "the model \"UAM-05LP\" is not known";
  EXPECT_THAT(the_bad_one(facts).cure, AllOf(HasSubstr("model is not known"), Not(HasSubstr("clean"))));
}

TEST(Doctor, WhatIsInsideTheOutlineIsMaskedNotMoved) {
  DoctorFacts facts = healthy();
  facts.base.control.reason = motion::GateReason::kBlocked;
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("move it"));
  facts.base.control.own_echo = types::Sector{38.0 * types::kDegree_rad, 42.0 * types::kDegree_rad};
  EXPECT_THAT(the_bad_one(facts).found, HasSubstr("seen inside the robot's own outline at 40 degrees"));
  EXPECT_THAT(the_bad_one(facts).cure,
              AllOf(HasSubstr("mask it: scanner.front.masks_deg with [37, 43]"), Not(HasSubstr("move it"))));
  // What --check-config would refuse is no cure.
  facts.base.control.own_echo = types::Sector{-3.0 * types::kDegree_rad, 3.0 * types::kDegree_rad};
  EXPECT_THAT(the_bad_one(facts).cure, AllOf(HasSubstr("cannot be masked"), Not(HasSubstr("mask it"))));
}

TEST(Doctor, StopButtonAndLatch) {
  DoctorFacts facts = healthy();
  facts.estop_latched = true;
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("clear-estop"));
  facts.estop_latched = false;
  facts.base.state.stop_button = true;
  EXPECT_THAT(the_bad_one(facts).found, HasSubstr("stop button"));
}

TEST(Doctor, LatchThatIsNotKept) {
  DoctorFacts facts = healthy();
  facts.estop_latched = true;
  facts.estop_trouble = "latched, but not kept over a restart: the disk is full";
  EXPECT_THAT(the_bad_one(facts).found, HasSubstr("the disk is full"));
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("control.state_folder"));
}

/// The base reports once a period, and an operator may ask right behind his clear-estop.
TEST(Doctor, AReportFromBeforeTheClearIsNoComplaint) {
  DoctorFacts facts = healthy();
  facts.base.control.estop_latched = true;
  facts.base.control.reason = motion::GateReason::kEmergencyStop;
  for (const Check& check : examine(facts)) EXPECT_TRUE(check.ok) << check.name << ": " << check.found;
  facts.estop_latched = true;
  std::vector<std::string> bad;
  for (const Check& check : examine(facts))
    if (!check.ok) bad.push_back(check.name);
  EXPECT_EQ(bad, (std::vector<std::string>{"e-stop", "motion"}));
}

TEST(Doctor, MotorsBumpersBattery) {
  DoctorFacts facts = healthy();
  facts.base.control.mode = pipeline::ControlMode::kFollowing;
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("MOTORS"));
  facts = healthy();
  facts.base.state.stall_left = true;
  EXPECT_THAT(the_bad_one(facts).found, HasSubstr("left wheel"));
  facts = healthy();
  facts.base.state.bumpers_front = 4;
  EXPECT_EQ(the_bad_one(facts).name, "bumpers");
  facts = healthy();
  facts.base.state.battery_v = 11.0F;
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("charge it"));
  facts.base.state.battery_v = 12.6F;
  facts.base.state.state_of_charge = 0.1F;
  EXPECT_EQ(the_bad_one(facts).found, "12.6 V, 10 %");
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("or 20 % (exploration.charge_home) the robot goes home"));
  facts.base.state.battery_v = 0.0F;
  EXPECT_EQ(the_bad_one(facts).found, "voltage not reported, 10 %");
  facts.base.state.state_of_charge = -1.0F;
  for (const Check& check : examine(facts)) EXPECT_TRUE(check.ok) << check.name << ": " << check.found;
}

TEST(Doctor, SensorsMapAndMachine) {
  DoctorFacts facts = healthy();
  facts.base.control.reason = motion::GateReason::kStaleScan;
  EXPECT_EQ(the_bad_one(facts).name, "motion");
  facts = healthy();
  facts.scans_lost_lately = 101;
  EXPECT_THAT(the_bad_one(facts).found, HasSubstr("101 of the last 201"));
  facts = healthy();
  facts.stuck = {"mapping"};
  EXPECT_EQ(the_bad_one(facts).name, "threads");
  facts = healthy();
  facts.policy = RealtimePolicy::kTry;
  facts.refusals = {"no SCHED_FIFO 45"};
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("LimitRTPRIO"));
  facts = healthy();
  facts.disks.back().free_bytes = 1 << 20;
  EXPECT_THAT(the_bad_one(facts).cure, HasSubstr("make room"));
  facts.disks.back().free_bytes.reset();
  EXPECT_THAT(the_bad_one(facts).found, HasSubstr("cannot be used"));
}

TEST(Doctor, EveryReasonToStandHasItsCure) {
  for (int i = 0; i <= static_cast<int>(motion::GateReason::kReverse); ++i) {
    DoctorFacts facts = healthy();
    facts.base.control.reason = static_cast<motion::GateReason>(i);
    for (const Check& check : examine(facts)) EXPECT_EQ(check.ok, check.cure.empty()) << i << check.name;
  }
}

}  // namespace
}  // namespace topo::daemon

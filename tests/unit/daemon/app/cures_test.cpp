// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Each cure fits its cause: devices of which the test knows what is the matter, through their drivers to what
// the doctor advises.
#include <gmock/gmock.h>

#include <functional>
#include <string>
#include <vector>

#include "daemon/app/doctor.hpp"
#include "daemon/threads/device_report.hpp"
#include "tests/unit/drivers/hokuyo/connection_fixture.hpp"
#include "tests/unit/drivers/pioneer/connection_fixture.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;

template <class Connection>
Check advice(const std::string& name, const std::string& address, const Connection& connection) {
  DeviceReport report;
  fill_report(report, connection);
  DoctorFacts facts;
  facts.devices = {
      {name, address, report.state.str(), report.message.str(), report.working, report.assumed.str()}};
  return examine(facts).front();
}

/// What the advice must say of a cause, and what would be wrong; the state that the driver chose.
struct Expected {
  std::string state, says;
  std::vector<std::string> wrong;
};

void expect_fits(const char* cause, const Check& check, const Expected& expected) {
  EXPECT_FALSE(check.ok) << cause;
  EXPECT_THAT(check.found, testing::StartsWith(expected.state)) << cause;
  EXPECT_THAT(check.cure, HasSubstr(expected.says)) << cause << ": " << check.found;
  for (const std::string& wrong : expected.wrong)
    EXPECT_THAT(check.found + check.cure, Not(HasSubstr(wrong))) << cause;
}

const std::vector<std::string> kNotOff{"switch the device on", "switched on?", "is it powered?", "repaired"};

class BaseCures : public pioneer::PioneerSession {
 protected:
  void expect(const char* cause, types::Duration after, const Expected& expected) {
    start();
    run(after);
    expect_fits(cause, advice("base", robot.port, *connection), expected);
    connection.reset();
  }
};

TEST_F(BaseCures, APortThatIsNotThere) {
  robot.port_exists = false;
  expect("no port", 1s, {"disconnected", "nothing answers at", {"repaired"}});
}

TEST_F(BaseCures, ARobotThatIsOff) {
  robot.powered = false;
  expect("off", 4s, {"silent", "switch the device on", {"repaired", "off and on"}});
}

TEST_F(BaseCures, ARobotThatIsBeingAsked) { expect("answers", 250ms, {"connecting", "wait", kNotOff}); }

TEST_F(BaseCures, AScannerAtItsAddress) {
  robot.chatter = "0Ee\n\n";
  expect("another device", 6s, {"wrong device", "exchange the plugs", kNotOff});
}

TEST_F(BaseCures, AnotherRobotsModelNameAndNumber) {
  robot.subclass = "p3at-sh";
  config.expected_chassis = "p3dx";
  expect("another model", 3s, {"wrong device", "exchange the plugs", kNotOff});
  config.expected_chassis.clear();
  config.expected_serial_number = "SN999";
  expect("another number", 3s, {"wrong device", "exchange the plugs", kNotOff});
}

TEST_F(BaseCures, ABoardThatIsNotKnown) {
  robot.subclass = "p3dx-lms200";
  expect("board", 3s, {"wrong device", "base.family", {"exchange the plugs", "switch the device on"}});
}

TEST_F(BaseCures, AStaleConnectionThatDoesNotObeyClose) {
  robot.open = robot.deaf_to_close = true;
  expect("stale", 6s, {"refuses", "switch the robot off and on", {"switch the device on", "cable"}});
}

TEST_F(BaseCures, NoStatusAfterOpen) {
  robot.sends_status = false;
  expect("no status", 1900ms, {"refuses", "switch the robot off and on", {"switch the device on"}});
}

TEST_F(BaseCures, ASerialNumberThatComesDamagedOrNot) {
  config.expected_serial_number = "SN123";
  robot.damages_config = true;
  expect("damaged", 3s, {"unidentified", "look at the line", {"no CONFIG packet", "switch the device on"}});
  robot.damages_config = false;
  robot.answers_config = false;
  expect("none", 3s, {"unidentified", "base.serial_number", {"damaged", "switch the device on"}});
}

TEST_F(BaseCures, AWatchdogThatIsNotTold) {
  robot.damages_config = true;
  expect("damaged", 3s, {"unsafe", "firmware watchdog", {"sent no", "switch the device on"}});
  config.watchdog_ms = 1000;
  expect("given", 3s, {"on trial", "topoctl drive 0 0.2", {"sent no", "switch the device on"}});
}

TEST_F(BaseCures, AControllerThatResets) {
  connect();
  robot.send({std::byte{0xFF}});
  robot.open = robot.motors = false;
  run(100ms);
  expect_fits("reset", advice("base", robot.port, *connection), {"reset", "by itself", kNotOff});
}

TEST_F(BaseCures, ARobotThatFallsSilent) {
  connect();
  robot.sends_status = false;
  run(700ms);
  expect_fits("silent", advice("base", robot.port, *connection),
              {"silent", "not heard any more", {"switch the device on", "repaired"}});
}

TEST_F(BaseCures, ARobotThatDoesNotObey) {
  start();
  connection->set_silence(true);
  run(300ms);
  expect_fits("disobeys", advice("base", robot.port, *connection),
              {"unsafe", "stop button", {"firmware watchdog", "switch the device on"}});
}

class ScannerCures : public hokuyo::testing_scip::SessionTest {
 protected:
  using Break = std::function<void(hokuyo::testing_scip::FakeSensor&)>;
  void expect(const char* cause, const Break& make, types::Duration after, const Expected& expected,
              hokuyo::ConnectionConfig config = {}) {
    line = {};
    start(hokuyo::testing_scip::utm_ew(), std::move(config));
    make(*sensor);
    run_for(after);
    check(cause, expected);
  }
  void check(const char* cause, const Expected& expected) {
    expect_fits(cause, advice("front", "tcp:192.168.0.10:10940", *connection), expected);
  }
};

TEST_F(ScannerCures, AScannerThatIsOff) {
  expect("off", [](auto& s) { s.mute = true; }, 4s, {"silent", "switch the device on", {"repaired"}});
}

TEST_F(ScannerCures, AScannerThatBoots) {
  expect("spins up", [](auto& s) { s.laser_failures = 6; }, 1500ms, {"starting", "wait", kNotOff});
}

TEST_F(ScannerCures, ALaserThatDoesNotSwitchOn) {
  expect("laser", [](auto& s) { s.laser_failures = -1; }, 12s,
         {"fault", "switch it off and on", {"switch the device on", "clean"}});
}

TEST_F(ScannerCures, AnAnswerThatComesDamaged) {
  expect("damaged serial number", [](auto& s) { s.vv = "PROD:UTM-30LX-EW;R\nSERI:H0123456;0\n"; }, 4s,
         {"damaged", "cable", {"repaired", "switch the device on", "exchange"}});
}

TEST_F(ScannerCures, ParametersThatCannotBe) {
  expect("front step",
         [](auto& s) {
           const std::string text = "AFRT:9000";
           s.pp.replace(s.pp.find("AFRT"), 10, text + ";" + std::string(1, hokuyo::checksum(text)));
         },
         4s,
         {"unusable", "nothing is wrong with the scanner", {"repaired", "switch the device on", "cable"}});
}

TEST_F(ScannerCures, AnotherSensor) {
  expect("exchanged", [](auto&) {}, 2s, {"wrong device", "exchange the plugs", kNotOff},
         {.name = "front", .serial_number = "H7654321"});
}

TEST_F(ScannerCures, WhatItReportsWhileItStreams) {
  start(hokuyo::testing_scip::utm_ew());
  ASSERT_TRUE(run_scans(5, 5s));
  sensor->inject_status = "72";
  ASSERT_TRUE(run_health(hokuyo::Health::kFault, 1s));
  check("hardware", {"fault", "repaired", {"switch the device on", "clean"}});
}

TEST_F(ScannerCures, ASelfCheckIsNoRepair) {
  start(hokuyo::testing_scip::utm_ew());
  ASSERT_TRUE(run_scans(5, 5s));
  sensor->inject_status = "30";
  ASSERT_TRUE(run_health(hokuyo::Health::kFault, 1s));
  check("checks itself", {"fault", "wait", {"repaired", "switch the device on"}});
}

TEST_F(ScannerCures, AScannerThatFallsSilent) {
  start(hokuyo::testing_scip::utm_ew());
  ASSERT_TRUE(run_scans(5, 5s));
  sensor->mute = true;
  run_for(900ms);
  check("cut", {"silent", "not heard any more", {"switch the device on", "repaired"}});
}

}  // namespace
}  // namespace topo::daemon

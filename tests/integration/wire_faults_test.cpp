// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Every fault that toposim can inject, over real wires, into a robot on a mission at full speed (issue "Map
// to home", base thread and safety). safety_sim_test has the same of values in lock-step.
#include "tests/integration/wire_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>

#include "tests/integration/content_faults.hpp"
#include "tests/integration/fault_table.hpp"
#include "tests/integration/said.hpp"
#include "tests/integration/wire_setups.hpp"
#include "tests/sim/devices/commands.hpp"

namespace topo::test {
namespace {

constexpr double kPatience_s = 40.0;

/// One rig goes from case to case of a suite as long as all is well: a daemon has to live through one fault
/// after the other.
class WireTest : public testing::Test {
 protected:
  static void TearDownTestSuite() { rig_.reset(); }
  void TearDown() override {
    if (HasFailure()) rig_.reset();
  }

  void use(const WireSetup& setup) {
    if (setup != setup_) rig_.reset();
    setup_ = setup;
    if (rig_ == nullptr) rig_ = WireRig::start(setup);
    ASSERT_NE(rig_, nullptr);
  }

  static Evidence evidence() { return {rig_->moment(), rig_->status()}; }

  /// On a mission, as fast as may be, with nothing within seven metres ahead.
  Evidence at_full_speed() {
    EXPECT_TRUE(rig_->reach_full_speed()) << rig_->status().dump(2);
    return evidence();
  }

  static bool until_it_stands() {
    constexpr double kLongEnough_s = 8.0;
    int looks = 0;  // in a row: a wheel that changes its direction stands for a moment
    return WireRig::wait(kLongEnough_s, [&looks] {
      looks = rig_->moment().stands ? looks + 1 : 0;
      return looks >= 5;
    });
  }

  /// How far it rolled from the blow until it stood.
  static double way_from(const Moment& hit) { return rig_->moment().truth.path_m - hit.truth.path_m; }

  void stands_within(const Moment& hit, double noticed_s) {
    ASSERT_TRUE(until_it_stands()) << rig_->status().dump(2);
    const double late_s = rig_->machine().late_s();
    const double way_m = way_from(hit), limit_m = stopping_distance_m(hit.v_mps, noticed_s, late_s);
    std::printf("at %.2f m/s: stands after %.2f m (limit %.2f m; the machine was up to %.0f ms late)\n",
                hit.v_mps, way_m, limit_m, 1e3 * late_s);
    EXPECT_LT(way_m, limit_m);
  }

  static void stays_standing(double seconds) {
    const double stood_m = rig_->moment().truth.path_m;
    EXPECT_FALSE(WireRig::wait(seconds, [&] { return rig_->moment().truth.path_m > stood_m + 1e-6; }))
        << "it went off by itself\n"
        << rig_->status().dump(2);
  }

  static bool has_everything_back() {
    const Json devices = rig_->status()["devices"];
    return std::all_of(devices.begin(), devices.end(), [](const Json& d) { return d["working"] == true; });
  }

  static bool is_under_way() {
    return rig_->moment().v_mps > 0.3 || rig_->status()["mission"]["reason"] == "arrived";
  }

  /// Whatever the fault was: with all links back the mission goes on; a doubt that came the third time within
  /// a minute (the cases follow each other closely) by the operator's clear. What it took.
  static std::string goes_on() {
    EXPECT_TRUE(WireRig::wait(kPatience_s, has_everything_back)) << rig_->status().dump(2);
    constexpr double kByItself_s = 12.0;
    if (WireRig::wait(kByItself_s, is_under_way)) return "by itself";
    const Json status = rig_->status();
    const bool doubted = !status["plausibility"]["doubts"].empty();
    if (doubted) rig_->ask("clear_estop");
    EXPECT_TRUE(WireRig::wait(kPatience_s, is_under_way)) << status.dump(2);
    return doubted ? "by itself, or by clear-estop for the third within a minute" : "by itself";
  }

  /// A box of 0.4 m is there, 1 m ahead, for some seconds.
  void stops_before_a_box() {
    const auto [hit, answers] = rig_->strike_and_hear({{{"command", "obstacle"}, {"distance_m", 1.0}}});
    double slowest_mps = hit.v_mps;
    WireRig::wait(3.0, [&] {
      slowest_mps = std::min(slowest_mps, rig_->moment().v_mps);
      return slowest_mps < 0.02;
    });
    std::printf("box 1 m ahead at %.2f m/s: slowest %.2f m/s, after %.2f m\n", hit.v_mps, slowest_mps,
                way_from(hit));
    rig_->strike({{{"command", "remove-obstacle"}, {"id", answers[0]["id"]}}});
  }

  inline static std::unique_ptr<WireRig> rig_;
  inline static WireSetup setup_;
};

struct Case {
  WireSetup setup;
  WireFault fault;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.fault; }

/// Every device's faults; those of the base on both kinds of wires always.
std::vector<Case> cases(Wires wires, bool sonar) {
  std::vector<Case> all;
  std::size_t number = 0;
  const auto add = [&](const std::string& device, std::vector<WireFault> faults) {
    for (WireFault& fault : faults) {
      fault.name = device + "_" + fault.name;
      for (const WireSetup& setup : setups_of(number++))
        if (setup.wires == wires && setup.sonar == sonar) all.push_back({setup, fault});
    }
  };
  add("front", front_faults());
  add("coronal", coronal_faults());
  add("base", base_faults());
  if (!is_cross()) add("base", base_faults());  // an odd number of faults: each on the other wires now
  return all;
}

class WireFaults : public WireTest, public testing::WithParamInterface<Case> {};
std::string name_of(const testing::TestParamInfo<Case>& info) {
  return info.param.fault.name + suffix_of(info.param.setup);
}
INSTANTIATE_TEST_SUITE_P(Tcp, WireFaults, testing::ValuesIn(cases(Wires::kTcp, true)), name_of);
INSTANTIATE_TEST_SUITE_P(TcpWithoutSonar, WireFaults, testing::ValuesIn(cases(Wires::kTcp, false)), name_of);
INSTANTIATE_TEST_SUITE_P(Terminal, WireFaults, testing::ValuesIn(cases(Wires::kPty, true)), name_of);
INSTANTIATE_TEST_SUITE_P(TerminalWithoutSonar, WireFaults, testing::ValuesIn(cases(Wires::kPty, false)),
                         name_of);

/// "front_drop_of_some_bytes" as the table has it.
std::string title_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name.replace(name.find(' '), 1, ": ");
}

TEST_P(WireFaults, StopsInTimeOrDrivesOnSafelyAndRecovers) {
  const WireFault& fault = GetParam().fault;
  ASSERT_NO_FATAL_FAILURE(use(GetParam().setup));
  const Evidence before = at_full_speed();
  const Moment hit = rig_->strike(fault.strike);
  Said said;
  std::string does = "drives on";
  if (fault.outcome == Outcome::kStops) {
    stands_within(hit, fault.noticed_s);
    does = stands_after(way_from(hit), rig_->moment().truth.sim_s - hit.truth.sim_s);
  }
  EXPECT_TRUE(WireRig::wait(kPatience_s,
                            [&] {
                              said.listen(*rig_);
                              return fault.has_struck(before, evidence());
                            }))
      << "the fault did not strike\n"
      << rig_->status().dump(2);
  if (fault.outcome == Outcome::kStops && !fault.lift.empty()) stays_standing(0.5);
  if (fault.outcome == Outcome::kDrivesOn) {
    EXPECT_GT(rig_->moment().v_mps, 0.5) << "it may drive on";
  }
  if (fault.outcome != Outcome::kStops && fault.box_after) {
    stops_before_a_box();
    does += fault.outcome == Outcome::kTouchesNothing ? " or stops, and stops before the box"
                                                      : ", stops before the box";
  }
  said.listen(*rig_);
  rig_->strike(fault.lift);
  const std::string back = goes_on();
  const Moment after = rig_->moment();
  EXPECT_EQ(after.truth.collisions, hit.truth.collisions) << "it touched something";
  record({title_of(fault.name), form_of(GetParam().setup), does, said.text(),
          HasFailure() ? "not as it should" : back});
}

WireSetup setup_on(Wires wires) {
  WireSetup setup;
  setup.wires = wires;
  return setup;
}
WireSetup setup_with_watchdog(int watchdog_ms) {
  WireSetup setup;
  setup.watchdog_ms = watchdog_ms;
  return setup;
}

class WireEvents : public WireTest, public testing::WithParamInterface<Wires> {
 protected:
  void SetUp() override { ASSERT_NO_FATAL_FAILURE(use(setup_on(GetParam()))); }
};
std::string name_of_link(const testing::TestParamInfo<Wires>& info) {
  return info.param == Wires::kTcp ? "Tcp" : "Terminal";
}
INSTANTIATE_TEST_SUITE_P(, WireEvents, testing::Values(Wires::kTcp, Wires::kPty), name_of_link);

TEST_P(WireEvents, BoxesThatAppearAMetreAheadAreNotTouched) {
  for (int i = 0; i < 3; ++i) {
    const Evidence before = at_full_speed();
    stops_before_a_box();
    goes_on();
    EXPECT_EQ(rig_->moment().truth.collisions, before.moment.truth.collisions);
  }
}

TEST_P(WireEvents, TheStopButtonLatchesUntilTheOperatorSaysSo) {
  const Evidence before = at_full_speed();
  const Moment hit = rig_->strike({{{"command", "stop-button"}, {"pressed", true}}});
  stands_within(hit, 0.0);  // the firmware stops by itself
  EXPECT_TRUE(WireRig::wait(kPatience_s, [] { return rig_->status()["estop"] == true; }));
  EXPECT_TRUE(WireRig::wait(kPatience_s, [] { return rig_->status()["mission"]["state"] == "paused"; }));
  rig_->strike({{{"command", "stop-button"}, {"pressed", false}}});
  EXPECT_TRUE(WireRig::wait(kPatience_s, [&] { return rig_->moment().truth.sim_s > hit.truth.sim_s + 0.5; }));
  stays_standing(1.0);
  EXPECT_FALSE(rig_->try_ask("resume")) << "latched";
  rig_->ask("clear_estop");
  stays_standing(1.0);
  EXPECT_TRUE(WireRig::wait(kPatience_s, [] { return rig_->try_ask("resume"); }));
  goes_on();
  EXPECT_EQ(rig_->moment().truth.collisions, before.moment.truth.collisions);
}

TEST_P(WireEvents, APressedFrontBumperStopsItAndItLeavesBackwards) {
  const Evidence before = at_full_speed();
  const Moment hit = rig_->strike({{{"command", "bumper"}, {"front", 4}, {"seconds", 2.0}}});
  EXPECT_TRUE(WireRig::wait(kPatience_s, [] { return rig_->status()["bumpers"]["front"] == 4; }));
  double furthest_m = 0.0, slowest_mps = hit.v_mps;
  EXPECT_TRUE(WireRig::wait(kPatience_s, [&] {
    const Moment now = rig_->moment();
    furthest_m = std::max(furthest_m, (now.truth.pose.translation() - hit.truth.pose.translation()).norm());
    slowest_mps = std::min(slowest_mps, now.v_mps);
    return slowest_mps < -0.05;
  })) << rig_->status().dump(2);
  constexpr double kNoticed_s = 0.160;  // a status cycle and its delay
  EXPECT_LT(furthest_m, stopping_distance_m(hit.v_mps, kNoticed_s, rig_->machine().late_s()));
  goes_on();
  EXPECT_EQ(rig_->moment().truth.collisions, before.moment.truth.collisions);
}

TEST_P(WireEvents, ACutBeforeAWallEndsBeforeTheWall) {
  // The worst moment for the link to break: as near to the wall as the firmware's watchdog allows any speed.
  at_full_speed();
  rig_->ask("stop");
  // A person drives straight at the wall, as fast as may be.
  ASSERT_TRUE(WireRig::wait(kPatience_s, [] {
    const Moment now = rig_->moment();
    const types::Se2& pose = now.truth.pose;
    const double side = std::cos(pose.theta_rad) > 0.0 ? 1.0 : -1.0;
    const double error_rad = std::asin(side * std::sin(pose.theta_rad)) + 0.3 * side * (pose.y_m - 4.0);
    rig_->ask("drive", {{"v_mps", WireRig::kV_mps}, {"omega_radps", std::clamp(-error_rad, -0.3, 0.3)}});
    return WireRig::room_ahead_m(now) < 2.2;
  })) << rig_->status().dump(2);
  const Moment hit = rig_->strike({{{"command", "cut"}, {"device", "base"}, {"seconds", 4.0}}});
  EXPECT_GT(hit.v_mps, 0.2);
  EXPECT_TRUE(until_it_stands());
  std::printf("%.2f m before a wall at %.2f m/s: rolls %.2f m\n", WireRig::room_ahead_m(hit), hit.v_mps,
              way_from(hit));
  EXPECT_GT(way_from(hit), hit.v_mps) << "it was the watchdog that stopped it";
  EXPECT_TRUE(WireRig::wait(kPatience_s, has_everything_back));
  EXPECT_GT(rig_->moment().e_stops, hit.e_stops) << "E_STOP is the first that an opened port hears";
  stays_standing(1.0);  // nobody asks for anything any more
  EXPECT_EQ(rig_->moment().truth.collisions, hit.truth.collisions);
}

class WireEventsOnce : public WireTest {};

TEST_F(WireEventsOnce, ALowBatteryMeansHome) {
  ASSERT_NO_FATAL_FAILURE(use({}));
  const Evidence before = at_full_speed();
  rig_->strike({{{"command", "battery"}, {"volts", 11.0}}});
  EXPECT_TRUE(WireRig::wait(2 * kPatience_s, [] { return rig_->status()["mission"]["state"] == "failed"; }))
      << rig_->status().dump(2);
  const Json status = rig_->status();
  EXPECT_NEAR(status["battery_v"].get<double>(), 11.0, 0.06);
  EXPECT_NE(status["mission"]["reason"].get<std::string>().find("battery"), std::string::npos)
      << status["mission"];
  const types::Se2 home = rig_->moment().truth.pose;
  EXPECT_LT((home.translation() - types::Vector2(2.0, 4.0)).norm(), 0.5);
  rig_->strike({{{"command", "battery"}, {"volts", 12.7}}});
  EXPECT_TRUE(WireRig::wait(kPatience_s, [] { return rig_->status()["battery_v"] > 12.0; }));
  EXPECT_EQ(rig_->moment().truth.collisions, before.moment.truth.collisions);
}

TEST_F(WireEventsOnce, PeopleWhoCrossTheWayAreNotTouched) {
  ASSERT_NO_FATAL_FAILURE(use({}));
  const Evidence before = at_full_speed();
  rig_->simulator().with_rig([&](sim::SimRig& sim) {
    for (const double ahead_m : {2.0, 4.0}) {
      sim::Walker walker;
      const types::Vector2 at = before.moment.truth.pose * types::Vector2(ahead_m, 2.0);
      const types::Vector2 to = before.moment.truth.pose * types::Vector2(ahead_m, -2.0);
      walker.way_points = {at, to};
      sim.simulation().add_walker(walker);
    }
  });
  const auto have_walked = [&] {
    constexpr double kCrossings_s = 20.0;
    return rig_->moment().truth.sim_s > before.moment.truth.sim_s + kCrossings_s;
  };
  ASSERT_TRUE(WireRig::wait(2 * kPatience_s, have_walked));
  EXPECT_EQ(rig_->moment().truth.collisions, before.moment.truth.collisions);
  // A person who waits for the robot that waits for the person waits for ever: they leave.
  rig_->simulator().with_rig([](sim::SimRig& sim) { sim.simulation().remove_walkers(); });
  const auto is_past = [&] {
    return (rig_->moment().truth.pose.translation() - before.moment.truth.pose.translation()).norm() > 5.0;
  };
  EXPECT_TRUE(WireRig::wait(kPatience_s, is_past)) << rig_->status().dump(2);
  EXPECT_EQ(rig_->moment().truth.collisions, before.moment.truth.collisions);
}

TEST_F(WireEventsOnce, AFirmwareWithoutAGoodWatchdogIsNotDriven) {
  for (const int watchdog_ms : {0, 3000}) {
    ASSERT_NO_FATAL_FAILURE(use(setup_with_watchdog(watchdog_ms)));
    EXPECT_TRUE(WireRig::wait(kPatience_s, [] {
      const Json status = rig_->status();
      return status["devices"]["base"]["state"] == "unsafe" && status["map"]["keyframes"] >= 1;
    })) << rig_->status().dump(2);
    EXPECT_FALSE(rig_->try_ask("start"));
    const double path_m = rig_->moment().truth.path_m;
    EXPECT_FALSE(WireRig::wait(1.0, [&] {
      rig_->try_ask("drive", {{"v_mps", 0.3}, {"omega_radps", 0.0}});
      return rig_->moment().truth.path_m > path_m;
    }));
    rig_.reset();
  }
}

TEST(WireFaultsTable, HasEveryFaultThatToposimCanInject) {
  std::set<std::string> named{"truth",    "status",      "remove-obstacle", "person",    // no faults
                              "obstacle", "stop-button", "bumper",          "battery"};  // events, above
  for (const auto& faults : {front_faults(), coronal_faults(), base_faults()})
    for (const WireFault& fault : faults)
      for (const Json& strike : fault.strike) named.insert(strike["command"]);
  for (const ContentFault& fault : content_faults())
    for (const Json& strike : fault.strike) named.insert(strike["command"]);
  std::istringstream help(sim::command_help());
  for (std::string line, name; std::getline(help, line);) {
    std::istringstream(line) >> name;
    EXPECT_TRUE(named.contains(name)) << "no test injects " << name;
  }
}

}  // namespace
}  // namespace topo::test

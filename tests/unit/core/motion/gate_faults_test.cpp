// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What keeps the gate shut; velocity_gate_test.cpp has how fast it lets a robot drive.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <set>
#include <string_view>
#include <vector>

#include "tests/unit/core/motion/gate_scene.hpp"
#include "tests/unit/core/motion/generators.hpp"

namespace topo::motion {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(GateFaults, StampsAreStaleWhenOldMissingOrFromTheFuture) {
  const Stamp now{std::chrono::seconds(5)};
  EXPECT_FALSE(is_stale(now, now, milliseconds(300)));
  EXPECT_FALSE(is_stale(now - milliseconds(300), now, milliseconds(300)));
  EXPECT_TRUE(is_stale(now - milliseconds(301), now, milliseconds(300)));
  EXPECT_TRUE(is_stale(now + milliseconds(21), now, milliseconds(300)));
  EXPECT_TRUE(is_stale(Stamp{}, Stamp{milliseconds(10)}, milliseconds(300)));
}

TEST(GateFaults, AScanMayBeTwoAndAHalfPeriodsOld) {
  auto scan = empty_scan(Stamp{});
  EXPECT_EQ(scan_age_max(*scan, {}), milliseconds(150));
  scan->geometry.period_s = 0.1F;
  EXPECT_NEAR(types::to_seconds(scan_age_max(*scan, {})), 0.25, 1e-6);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -1.0F, 1e9F}) {
    scan->geometry.period_s = bad;
    EXPECT_EQ(scan_age_max(*scan, {}), milliseconds(150));
  }
}

struct Fault {
  const char* name;
  GateReason reason;
  std::function<void(Scene&)> make;
};

const std::vector<Fault>& faults() {
  static const std::vector<Fault> kFaults{
      {"no request for 301 ms", GateReason::kStaleRequest,
       [](Scene& s) { s.input.request.stamp = s.now - milliseconds(301); }},
      {"no request ever", GateReason::kStaleRequest, [](Scene& s) { s.input.request.stamp = Stamp{}; }},
      {"v is NaN", GateReason::kInvalidRequest, [](Scene& s) { s.input.request.twist.v_mps = kNaN; }},
      {"omega is infinite", GateReason::kInvalidRequest,
       [](Scene& s) { s.input.request.twist.omega_radps = HUGE_VAL; }},
      {"reverse", GateReason::kReverse, [](Scene& s) { s.input.request.twist.v_mps = -0.05; }},
      {"no status", GateReason::kStaleStatus, [](Scene& s) { s.input.base = nullptr; }},
      {"status 301 ms old", GateReason::kStaleStatus,
       [](Scene& s) { s.base.arrival = s.now - milliseconds(301); }},
      {"pose is NaN", GateReason::kInvalidStatus,
       [](Scene& s) {
         s.base.odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(kNaN, 0.0, 0.0);
       }},
      {"measured twist is NaN", GateReason::kInvalidStatus,
       [](Scene& s) { s.base.odometry.twist.omega_radps = kNaN; }},
      {"left wheel stalls", GateReason::kStall, [](Scene& s) { s.base.stall_left = true; }},
      {"right wheel stalls", GateReason::kStall, [](Scene& s) { s.base.stall_right = true; }},
      {"front bumper", GateReason::kBumper, [](Scene& s) { s.base.bumpers_front = 4; }},
      {"rear bumper", GateReason::kBumper, [](Scene& s) { s.base.bumpers_rear = 1; }},
      {"stop button", GateReason::kEmergencyStop, [](Scene& s) { s.base.stop_button = true; }},
      {"operator's e-stop", GateReason::kEmergencyStop, [](Scene& s) { s.input.estop_pressed = true; }},
      {"no scan", GateReason::kStaleScan, [](Scene& s) { s.input.front_scan = nullptr; }},
      {"scan 151 ms old", GateReason::kStaleScan,
       [](Scene& s) { s.scan->arrival = s.now - milliseconds(151); }},
      {"empty scan", GateReason::kBlindScan, [](Scene& s) { s.scan->beams = 0; }},
      {"blind scan", GateReason::kBlindScan,
       [](Scene& s) {
         for (std::size_t i = 0; i < s.scan->beams; i += 3)
           s.scan->range_m[i] = s.scan->range_m[i + 1] = types::kInvalid;
       }},
      {"mount is NaN", GateReason::kBlindScan, [](Scene& s) { s.input.T_base_laser.x_m = kNaN; }},
      {"mount's angle is NaN", GateReason::kBlindScan,
       [](Scene& s) { s.input.T_base_laser.theta_rad = kNaN; }},
      {"scanner looks backwards", GateReason::kBlindScan,
       [](Scene& s) { s.input.T_base_laser.theta_rad = 3.14; }},
      {"scanner sees one side only", GateReason::kBlindScan,
       [](Scene& s) { s.scan->beams = 500; }},  // from -135 to -10 degrees
      {"watchdog off", GateReason::kNoWatchdog, [](Scene& s) { s.input.firmware_watchdog = {}; }},
      {"watchdog slow", GateReason::kNoWatchdog,
       [](Scene& s) { s.input.firmware_watchdog = milliseconds(3000); }},
      {"limits are NaN", GateReason::kInvalidLimits,
       [](Scene& s) { s.input.limits.deceleration_mps2 = kNaN; }},
      {"limits are zero", GateReason::kInvalidLimits, [](Scene& s) { s.input.limits.v_max_mps = 0.0; }},
  };
  return kFaults;
}

TEST(GateFaults, EveryFaultStopsAndIsNamed) {
  for (const Fault& fault : faults()) {
    Scene scene;
    ASSERT_EQ(scene.settle(0.5, 0.2).reason, GateReason::kFree);
    fault.make(scene);
    const auto out = scene.again();
    EXPECT_EQ(out.reason, fault.reason) << fault.name;
    EXPECT_TRUE(stands(out)) << fault.name;
    EXPECT_NE(to_text(out.reason), "unknown") << fault.name;
  }
}

TEST(GateFaults, AnyInputWithAFaultStands) {
  EXPECT_TRUE(rc::check([] {
    Scene scene;
    scene.settle(uniform(0.0, 0.7), uniform(-1.0, 1.0));
    scene.ask(uniform(0.0, 2.0), uniform(-3.0, 3.0));
    const auto count = *rc::gen::inRange<std::size_t>(1, 4);
    for (std::size_t i = 0; i < count; ++i)
      faults()[*rc::gen::inRange<std::size_t>(0, faults().size())].make(scene);
    RC_ASSERT(stands(scene.again()));
  }));
}

TEST(GateFaults, EmergencyStopLatchesUntilCleared) {
  Scene scene;
  scene.settle(0.5);
  scene.input.estop_pressed = true;
  auto out = scene.ask(0.5);
  EXPECT_TRUE(out.command.estop);
  EXPECT_FALSE(out.command.enable_motors);
  scene.input.estop_cleared = true;  // while it is pressed: nothing
  EXPECT_TRUE(scene.ask(0.5).command.estop);
  scene.input.estop_pressed = scene.input.estop_cleared = false;
  EXPECT_EQ(scene.ask(0.5).reason, GateReason::kEmergencyStop);
  scene.input.estop_cleared = true;
  out = scene.ask(0.5);
  EXPECT_FALSE(out.command.estop);
  scene.input.estop_cleared = false;
  EXPECT_EQ(scene.settle(0.5).reason, GateReason::kFree);
}

TEST(GateFaults, TheStopButtonLatchesToo) {
  Scene scene;
  scene.base.stop_button = true;
  scene.ask(0.5);
  scene.base.stop_button = false;
  EXPECT_EQ(scene.settle(0.5).reason, GateReason::kEmergencyStop);
}

TEST(GateFaults, EmergencyStopWinsOverEveryOtherFault) {
  for (const Fault& fault : faults()) {
    Scene scene;
    fault.make(scene);
    scene.input.estop_pressed = true;
    EXPECT_TRUE(scene.again().command.estop) << fault.name;
  }
}

TEST(GateFaults, AfterAStopItStartsFromRest) {
  Scene scene;
  scene.settle(0.5);
  scene.base.stall_left = true;
  scene.ask(0.5);
  scene.base.stall_left = false;
  EXPECT_LE(scene.ask(0.5).command.twist.v_mps, 0.3 * 0.05 + 1e-12);
}

TEST(GateFaults, WithAreaLimitsItMustKnowItsPlace) {
  types::AreaLimits area;
  Scene scene;
  scene.input.area = &area;
  EXPECT_EQ(scene.settle(0.5).reason, GateReason::kFree) << "there are no limits";
  area.keep_out.push_back({{50.0, 50.0}, {51.0, 50.0}, {51.0, 51.0}});
  EXPECT_EQ(scene.ask(0.5).reason, GateReason::kNoPlace);
  for (const types::Se2& bad : {types::Se2{kNaN, 0.0, 0.0}, {0.0, HUGE_VAL, 0.0}, {0.0, 0.0, kNaN}}) {
    scene.input.T_map_base = bad;
    const GateOutput out = scene.ask(0.5);
    EXPECT_EQ(out.reason, GateReason::kNoPlace);
    EXPECT_TRUE(stands(out));
  }
  scene.input.T_map_base = types::Se2{};
  EXPECT_EQ(scene.settle(0.5).reason, GateReason::kFree);
}

TEST(GateFaults, AProposedOrDroppedPlaceStandsWithoutLimits) {
  using types::PlaceStanding;
  for (const auto& [place, reason] : {std::pair(PlaceStanding::kProposed, GateReason::kPlaceProposed),
                                      std::pair(PlaceStanding::kDropped, GateReason::kPlaceDropped)}) {
    for (const bool by_hand : {false, true}) {
      Scene scene;
      scene.input.by_hand = by_hand;
      scene.input.T_map_base = types::Se2{};
      EXPECT_EQ(scene.settle(0.5).reason, GateReason::kFree);
      scene.input.place = place;
      const GateOutput out = scene.ask(0.5);
      EXPECT_EQ(out.reason, reason);
      EXPECT_TRUE(stands(out));
      scene.input.place = PlaceStanding::kKnown;
      EXPECT_EQ(scene.settle(0.5).reason, GateReason::kFree);
    }
  }
  EXPECT_NE(to_text(GateReason::kPlaceProposed), to_text(GateReason::kPlaceDropped));
}

TEST(GateFaults, EveryReasonHasATextOfItsOwn) {
  std::set<std::string_view> texts;
  constexpr int kReasons = static_cast<int>(GateReason::kImplausible) + 1;
  for (int i = 0; i < kReasons; ++i) texts.insert(to_text(static_cast<GateReason>(i)));
  EXPECT_EQ(texts.size(), static_cast<std::size_t>(kReasons));
  EXPECT_EQ(texts.count("unknown"), 0U);
}

}  // namespace
}  // namespace topo::motion

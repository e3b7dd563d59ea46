// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/value_faults.hpp"

#include <cmath>
#include <deque>
#include <memory>

#include "drivers/pioneer/round_trip.hpp"

namespace topo::test {
namespace {

using plausibility::Doubt;

/// The robot's line to its base, with a delay of every command.
struct LateLine {
  sim::SimTime delay;
  std::deque<std::pair<sim::SimTime, types::BaseCommand>> on_the_way{};
  void operator()(const types::BaseCommand& command, bench::VirtualBase& base, sim::SimTime now) {
    on_the_way.emplace_back(now + delay, command);
    for (; !on_the_way.empty() && on_the_way.front().first <= now; on_the_way.pop_front())
      base.command(on_the_way.front().second, now);
  }
};

/// Commands arrive late; the driver measures it by the next answer
/// (drivers/pioneer/round_trip.hpp).
std::function<void(DriveRig&)> late_commands(sim::SimTime delay) {
  return [delay](DriveRig& rig) {
    rig.carry = LateLine{delay};
    auto trip = std::make_shared<pioneer::RoundTrip>();
    auto answers = std::make_shared<std::deque<types::Stamp>>();
    trip->asked(types::Stamp{rig.simulation().now()});
    trip->answered(types::Stamp{rig.simulation().now()} +
                   std::chrono::milliseconds(100));  // before the fault
    rig.spoil_state = [trip, answers, delay](types::BaseState& b) {
      const types::Stamp now = b.arrival;
      while (!answers->empty() && answers->front() <= now) {
        trip->answered(answers->front());
        answers->pop_front();
      }
      trip->expire(now);
      if (trip->is_due(now)) {
        trip->asked(now);
        answers->push_back(now + delay);
      }
      b.round_trip = trip->trip();
    };
  };
}

/// The status packets of a base whose left encoder counts no more.
struct DeadEncoder {
  sim::Se2 pose{};
  std::optional<sim::Se2> last{};
  void operator()(types::BaseState& b) {
    constexpr double kTrack_m = 0.33;  // effective, of a P3-DX (PROTOCOLS section 6.2)
    const sim::Se2 here = b.odometry.T_odom_base.se2();
    if (!last) pose = here;
    const sim::Se2 step = last ? last->inverse() * here : sim::Se2{};
    last = here;
    const double right_m = step.x_m + step.theta_rad * kTrack_m / 2.0;
    pose = pose * sim::Se2{right_m / 2.0, 0.0, right_m / kTrack_m};
    b.odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(pose);
    const double right_mps = b.odometry.twist.v_mps + b.odometry.twist.omega_radps * kTrack_m / 2.0;
    b.odometry.twist = {right_mps / 2.0, right_mps / kTrack_m};
  }
};

}  // namespace

plausibility::MatchedMotion Matcher::operator()() {
  const sim::Se2 here = rig.body().truth();
  sim::Se2 step = last.inverse() * here;
  last = here;
  if (other_robots) step = {};
  step.y_m += carried_mps * types::to_seconds(types::kBasePeriod);
  if (upside_down) step = {step.x_m, -step.y_m, -step.theta_rad};
  motion = plausibility::after_scan(motion, rig.report().odometry.stamp, step,
                                    rig.report().odometry.T_odom_base.se2(), true);
  return motion;
}

void swallow(const types::BaseCommand& command, bench::VirtualBase& base, sim::SimTime now) {
  if (!command.silence) base.feed_watchdog(now);
}

void heal(DriveRig& rig) {
  rig.front_silent = rig.base_silent = rig.planner_silent = rig.estop = false;
  rig.spoil_scan = nullptr;
  rig.spoil_state = nullptr;
  rig.carry = nullptr;
  if (rig.match) rig.match = Matcher(rig);
  rig.told_watchdog = std::chrono::milliseconds(2000);
}

std::vector<ValueFault> lies() {
  using std::chrono::milliseconds;
  const auto scans = [](auto spoil) { return [spoil](DriveRig& rig) { rig.spoil_scan = spoil; }; };
  const auto states = [](auto spoil) { return [spoil](DriveRig& rig) { rig.spoil_state = spoil; }; };
  return {
      {"nothing: is wrong", std::nullopt, [](DriveRig&) {}},
      {"front: scans 0.35 s late", Doubt::kLateScans,
       scans([](types::Scan& s) { s.late = milliseconds(350); })},
      {"front: scans 2 s late", Doubt::kLateScans,
       scans([](types::Scan& s) { s.late = milliseconds(2000); })},
      {"base: statuses 0.35 s late", Doubt::kLateStatuses,
       states([](types::BaseState& b) { b.late = milliseconds(350); })},
      {"front: sees nothing", Doubt::kBlind, scans([](types::Scan& s) { s.range_m.fill(types::kNoReturn); })},
      {"front: sees nothing ahead", Doubt::kBlind, scans([](types::Scan& s) {
         for (std::size_t i = 0; i < s.beams; ++i)
           if (std::abs(s.angle_rad(i)) < 1.58F) s.range_m[i] = types::kNoReturn;
       })},
      {"front: repeats one picture", Doubt::kFrozen,
       [](DriveRig& rig) {
         auto kept = std::make_shared<std::optional<types::Scan>>();
         rig.spoil_scan = [kept](types::Scan& s) {
           if (!*kept) kept->emplace(s);
           s.range_m = (*kept)->range_m;
         };
       }},
      {"front: a quarter of the window covered", Doubt::kCovered, scans([](types::Scan& s) {
         for (std::size_t i = 0; i < s.beams; ++i)
           if (s.angle_rad(i) > 0.0F && s.angle_rad(i) < 0.8F) s.range_m[i] = types::kTooNear;
       })},
      {"front: half the window covered", Doubt::kCovered, scans([](types::Scan& s) {
         for (std::size_t i = 0; i < s.beams; ++i)
           if (s.angle_rad(i) > 0.0F && s.angle_rad(i) < 1.5F) s.range_m[i] = 0.03F;
       })},
      {"base: impossible speed", Doubt::kImpossibleMotion,
       states([](types::BaseState& b) { b.odometry.twist.v_mps = -6.1; })},
      {"base: impossible turning", Doubt::kImpossibleMotion,
       states([](types::BaseState& b) { b.odometry.twist.omega_radps = 9.0; })},
      {"base: pose jumps", Doubt::kImpossibleMotion,
       [](DriveRig& rig) {
         auto jumps = std::make_shared<int>(0);
         rig.spoil_state = [jumps](types::BaseState& b) {
           const sim::Se2 jump{++*jumps % 2 * 1.5, 0.0, 0.0};
           b.odometry.T_odom_base =
               types::Transform2<types::Odom, types::Base>(b.odometry.T_odom_base.se2() * jump);
         };
       }},
      {"base: commands 0.6 s late", Doubt::kAnswersLate, late_commands(milliseconds(600)), 3.5},
      {"base: commands 1.5 s late", Doubt::kAnswersLate, late_commands(milliseconds(1500)), 4.5},
      {"front: scanner of another robot", Doubt::kMatchDisagrees,
       [](DriveRig& rig) {
         Matcher matcher(rig);
         matcher.other_robots = true;
         rig.match = matcher;
       },
       2.5},
      {"robot: carried at walking pace while it drives", Doubt::kMatchDisagrees,
       [](DriveRig& rig) {
         Matcher matcher(rig);
         matcher.carried_mps = 0.8;
         rig.match = matcher;
       },
       2.5},
      {"front: scans late by 50 ms more every second", Doubt::kLateScans,
       [](DriveRig& rig) {
         rig.spoil_scan = [&rig, from_s = rig.now_s()](types::Scan& s) {
           s.late = types::from_seconds(0.05 * (rig.now_s() - from_s));
         };
       },
       9.0},
      {"front: half of the forward sector sees nothing", std::nullopt, scans([](types::Scan& s) {
         for (std::size_t i = 0; i < s.beams; ++i)
           if (s.angle_rad(i) > 0.02F && s.angle_rad(i) < 1.05F) s.range_m[i] = types::kNoReturn;
       })},
      {"base: heading jumps", Doubt::kImpossibleMotion,
       [](DriveRig& rig) {
         auto jumps = std::make_shared<int>(0);
         rig.spoil_state = [jumps](types::BaseState& b) {
           const sim::Se2 jump{0.0, 0.0, ++*jumps % 2 * 1.5};
           b.odometry.T_odom_base =
               types::Transform2<types::Odom, types::Base>(b.odometry.T_odom_base.se2() * jump);
         };
       }},
      {"base: the left encoder is dead", Doubt::kDisobeys,
       [](DriveRig& rig) {
         rig.match = Matcher(rig);
         rig.spoil_state = DeadEncoder{};
       },
       2.5},
      {"base: hears one command in ten", std::nullopt,
       [](DriveRig& rig) {
         auto count = std::make_shared<int>(0);
         rig.carry = [count](const types::BaseCommand& command, bench::VirtualBase& base, sim::SimTime now) {
           if (++*count % 10 == 0) base.command(command, now);
         };
       },
       1.5, false, true},
      {"base: the last status packet comes again and again", std::nullopt,
       [](DriveRig& rig) {
         rig.match = Matcher(rig);
         auto kept = std::make_shared<std::optional<types::BaseState>>();
         rig.spoil_state = [kept](types::BaseState& b) {
           if (!*kept) *kept = b;
           const types::BaseState now = b;
           b = **kept;
           b.arrival = now.arrival;
           b.sequence = now.sequence;
           b.odometry.stamp = now.odometry.stamp;
         };
       },
       1.5, false, true},
      {"base: sonar reads 0", std::nullopt, states([](types::BaseState& b) {
         for (types::SonarReading& echo : b.sonar) echo.range_m = 0.0F;
       })},
      {"base: sonar reads no echo", std::nullopt, states([](types::BaseState& b) {
         for (types::SonarReading& echo : b.sonar) echo.range_m = 5.0F;
       })},
      {"base: a wheel is stuck, by its own words", std::nullopt,
       states([](types::BaseState& b) { b.stall_left = true; })},
      {"nothing: scans match", std::nullopt, [](DriveRig& rig) { rig.match = Matcher(rig); }},
  };
}

std::vector<ValueFault> plain_faults() {
  const auto scans = [](auto spoil) { return [spoil](DriveRig& rig) { rig.spoil_scan = spoil; }; };
  const auto states = [](auto spoil) { return [spoil](DriveRig& rig) { rig.spoil_state = spoil; }; };
  return {
      {"front: silence", std::nullopt, [](DriveRig& r) { r.front_silent = true; }},
      {"base: silence", std::nullopt, [](DriveRig& r) { r.base_silent = true; }},
      {"daemon: no new plan", std::nullopt, [](DriveRig& r) { r.planner_silent = true; }},
      {"front: every beam failed", Doubt::kFailed,
       scans([](types::Scan& s) { s.range_m.fill(types::kInvalid); })},
      {"front: every beam too near", Doubt::kCovered,
       scans([](types::Scan& s) { s.range_m.fill(types::kTooNear); })},
      {"base: stop button", std::nullopt, states([](types::BaseState& b) { b.stop_button = true; }), 1.5,
       true},
      {"operator: e-stop", std::nullopt, [](DriveRig& r) { r.estop = true; }, 1.5, true},
      {"base: rear bumper", std::nullopt, states([](types::BaseState& b) { b.bumpers_rear = 2; })},
      {"base: speed is no number", std::nullopt,
       states([](types::BaseState& b) { b.odometry.twist.v_mps = std::nan(""); })},
      {"base: its watchdog is off", std::nullopt, [](DriveRig& r) { r.told_watchdog = {}; }},
      {"base: its watchdog is 3 s", std::nullopt,
       [](DriveRig& r) { r.told_watchdog = std::chrono::milliseconds(3000); }},
  };
}

}  // namespace topo::test

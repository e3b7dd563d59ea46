// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Faults in which everything arrives, in form and in time, and is wrong: the base thread's step in lock-step
// with the simulated robot. A box appears a metre ahead after the fault has begun.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <memory>
#include <string>

#include "drivers/pioneer/round_trip.hpp"
#include "tests/integration/drive_rig.hpp"
#include "tests/unit/sim/rooms.hpp"

namespace topo::test {
namespace {

using plausibility::Doubt;
using sim::Vector2;

const std::vector<Vector2> kWay{{2.0, 4.0}, {28.0, 4.0}};

std::vector<Vector2> straight() {
  std::vector<Vector2> points;
  for (int i = 0; i <= 260; ++i) points.push_back(kWay[0] + (kWay[1] - kWay[0]) * (i / 260.0));
  return points;
}

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

/// Scan matching without errors, of the odometry that was given.
struct Matcher {
  const DriveRig& rig;
  bool other_robots = false;  ///< the scanner is on a robot that stands
  bool upside_down = false;
  plausibility::MatchedMotion motion{};
  sim::Se2 last{};

  explicit Matcher(const DriveRig& of) : rig(of), last(of.body().truth()) {}
  plausibility::MatchedMotion operator()() {
    const sim::Se2 here = rig.body().truth();
    sim::Se2 step = last.inverse() * here;
    last = here;
    if (other_robots) step = {};
    if (upside_down) step = {step.x_m, -step.y_m, -step.theta_rad};
    motion = plausibility::after_scan(motion, rig.report().odometry.stamp, step,
                                      rig.report().odometry.T_odom_base.se2(), true);
    return motion;
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

struct Lie {
  const char* name;
  std::optional<Doubt> doubt;
  std::function<void(DriveRig&)> begin;
  double box_after_s = 1.5;  ///< from the fault to the box
};

std::vector<Lie> lies() {
  using std::chrono::milliseconds;
  const auto scans = [](auto spoil) { return [spoil](DriveRig& rig) { rig.spoil_scan = spoil; }; };
  const auto states = [](auto spoil) { return [spoil](DriveRig& rig) { rig.spoil_state = spoil; }; };
  return {
      {"nothing is wrong", std::nullopt, [](DriveRig&) {}},
      {"scans 0.35 s late", Doubt::kLateScans, scans([](types::Scan& s) { s.late = milliseconds(350); })},
      {"scans 2 s late", Doubt::kLateScans, scans([](types::Scan& s) { s.late = milliseconds(2000); })},
      {"statuses 0.35 s late", Doubt::kLateStatuses,
       states([](types::BaseState& b) { b.late = milliseconds(350); })},
      {"scanner sees nothing", Doubt::kBlind,
       scans([](types::Scan& s) { s.range_m.fill(types::kNoReturn); })},
      {"scanner sees nothing ahead", Doubt::kBlind, scans([](types::Scan& s) {
         for (std::size_t i = 0; i < s.beams; ++i)
           if (std::abs(s.angle_rad(i)) < 1.58F) s.range_m[i] = types::kNoReturn;
       })},
      {"scanner repeats one picture", Doubt::kFrozen,
       [](DriveRig& rig) {
         auto kept = std::make_shared<std::optional<types::Scan>>();
         rig.spoil_scan = [kept](types::Scan& s) {
           if (!*kept) kept->emplace(s);
           s.range_m = (*kept)->range_m;
         };
       }},
      {"a quarter of the window covered", Doubt::kCovered, scans([](types::Scan& s) {
         for (std::size_t i = 0; i < s.beams; ++i)
           if (s.angle_rad(i) > 0.0F && s.angle_rad(i) < 0.8F) s.range_m[i] = types::kTooNear;
       })},
      {"half the window covered", Doubt::kCovered, scans([](types::Scan& s) {
         for (std::size_t i = 0; i < s.beams; ++i)
           if (s.angle_rad(i) > 0.0F && s.angle_rad(i) < 1.5F) s.range_m[i] = 0.03F;
       })},
      {"impossible speed", Doubt::kImpossibleMotion,
       states([](types::BaseState& b) { b.odometry.twist.v_mps = -6.1; })},
      {"impossible turning", Doubt::kImpossibleMotion,
       states([](types::BaseState& b) { b.odometry.twist.omega_radps = 9.0; })},
      {"pose jumps", Doubt::kImpossibleMotion,
       [](DriveRig& rig) {
         auto jumps = std::make_shared<int>(0);
         rig.spoil_state = [jumps](types::BaseState& b) {
           const sim::Se2 jump{++*jumps % 2 * 1.5, 0.0, 0.0};
           b.odometry.T_odom_base =
               types::Transform2<types::Odom, types::Base>(b.odometry.T_odom_base.se2() * jump);
         };
       }},
      {"commands 0.6 s late", Doubt::kAnswersLate, late_commands(milliseconds(600)), 3.5},
      {"commands 1.5 s late", Doubt::kAnswersLate, late_commands(milliseconds(1500)), 4.5},
      {"scanner of another robot", Doubt::kMatchDisagrees,
       [](DriveRig& rig) {
         Matcher matcher(rig);
         matcher.other_robots = true;
         rig.match = matcher;
       },
       2.5},
      {"scans match", std::nullopt, [](DriveRig& rig) { rig.match = Matcher(rig); }},
  };
}

/// Over all seeds, the worst.
struct Row {
  std::string fault, begins, found;
  double way_m = 0.0, time_s = 0.0;
};

/// Into the file that TOPOMETRIC_FAULT_TABLE names: doc/faults.md is made by it.
void write_table(const std::vector<Row>& rows) {
  const char* path = std::getenv("TOPOMETRIC_FAULT_TABLE");
  if (path == nullptr) return;
  std::ofstream out(path);
  out << R"(# Faults in which everything arrives and is wrong

Written by `TOPOMETRIC_FAULT_TABLE=doc/faults.md build/release/tests/integration/plausibility_sim_test`: a P3-DX in
lock-step with the simulator, three seeds each, the fault from the start or at 0.7 m/s, a box 1 m ahead 1.5 s later
(late commands: 3.5 and 4.5 s, another robot's scanner: 2.5 s). Way and time are from the fault to standstill behind the
box, of the worst seed. No run touched anything. Commands that become late less than the time of one answer before an
obstacle appears are not known in time: at 0.7 m/s with 1.5 s of delay the robot runs 1.05 m before it brakes. The
faults of the wires are in `tests/integration/wire_faults.cpp`.

| fault | begins | way (m) | time (s) | what it says |
|---|---|---|---|---|
)";
  for (const Row& row : rows) {
    std::array<char, 64> figures{};
    std::snprintf(figures.data(), figures.size(), "%.2f | %.2f", row.way_m, row.time_s);
    out << "| " << row.fault << " | " << row.begins << " | " << figures.data() << " | " << row.found
        << " |\n";
  }
  out << "\nHow each doubt ends, and its cure:\n\n| doubt | found | cure |\n|---|---|---|\n";
  for (const plausibility::DoubtText& text : plausibility::doubt_texts())
    out << "| " << text.name << " | " << text.found << " | " << text.cure << " |\n";
}

struct Drive {
  std::unique_ptr<DriveRig> rig;
  double from_m = 0.0, from_s = 0.0, v_mps = 0.0;
};

Drive begin(std::uint64_t seed, bool at_start, const Lie& lie) {
  DriveSetup setup;
  setup.start = {2.0, 4.0, 0.0};
  setup.seed = seed;
  Drive drive{std::make_unique<DriveRig>(sim::scene(sim::hall_text()), setup)};
  DriveRig& rig = *drive.rig;
  if (at_start) lie.begin(rig);
  rig.go(straight());
  const double full_mps = rig.setup.limits.v_max_mps - 0.03;
  if (!at_start) {
    EXPECT_TRUE(rig.run(10.0, [&] { return rig.v_mps() > full_mps && rig.now_s() > 3.0; }));
  }
  drive.from_m = rig.body().path_m();
  drive.from_s = rig.now_s();
  drive.v_mps = rig.v_mps();
  if (!at_start) lie.begin(rig);
  return drive;
}

TEST(PlausibilitySim, NoLieEndsInACollision) {
  std::printf("%-32s %-6s %5s %9s %9s  %s\n", "fault", "begins", "seed", "way (m)", "time (s)", "found");
  std::vector<Row> rows;
  for (const Lie& lie : lies()) {
    for (const bool at_start : {true, false}) {
      Row row{lie.name, at_start ? "at the start" : "at 0.7 m/s", "nothing"};
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Drive drive = begin(seed, at_start, lie);
        DriveRig& rig = *drive.rig;
        bool doubted = false, boxed = false;
        double stood_m = -1.0, stood_s = 0.0;
        plausibility::DoubtSet all;
        rig.run(12.0, [&] {
          all |= rig.report().plausibility.doubts;
          if (lie.doubt && has(all, *lie.doubt)) doubted = true;
          if (!boxed && rig.now_s() - drive.from_s > lie.box_after_s) {
            boxed = true;
            EXPECT_TRUE(rig.simulation().add_box_ahead(0, 1.0).has_value());
          }
          const bool stands = std::abs(rig.v_mps()) < 1e-3 && rig.now_s() - drive.from_s > 0.5;
          if (stands && stood_m < 0.0 && boxed) {
            stood_m = rig.body().path_m() - drive.from_m;
            stood_s = rig.now_s() - drive.from_s;
          }
          return false;
        });
        std::printf("%-32s %-6s %5d %9.2f %9.2f  %s\n", lie.name, at_start ? "start" : "0.7",
                    static_cast<int>(seed), stood_m, stood_s,
                    std::string(plausibility::found_text(all)).c_str());
        row.way_m = std::max(row.way_m, stood_m);
        row.time_s = std::max(row.time_s, stood_s);
        if (all.any()) row.found = plausibility::found_text(all);
        EXPECT_EQ(rig.body().collisions(), 0U)
            << lie.name << (at_start ? " from the start" : " at full speed");
        EXPECT_EQ(doubted, lie.doubt.has_value()) << lie.name << " " << at_start;
        EXPECT_EQ(all.any(), lie.doubt.has_value()) << plausibility::found_text(all);
      }
      rows.push_back(row);
    }
  }
  write_table(rows);
}

TEST(PlausibilitySim, ABaseThatSwallowsStopsIsStoppedByItsWatchdog) {
  for (const double speed_mps : {0.3, 0.7}) {
    const Lie deaf{"swallows every command", Doubt::kDisobeys, [](DriveRig& rig) {
                     rig.carry = [](const types::BaseCommand& command, bench::VirtualBase& base,
                                    sim::SimTime now) {
                       if (!command.silence) base.feed_watchdog(now);
                     };
                   }};
    DriveSetup setup;
    setup.start = {2.0, 4.0, 0.0};
    DriveRig rig(sim::scene(sim::hall_text()), setup);
    rig.by_hand = types::Twist2{speed_mps, 0.0};
    ASSERT_TRUE(rig.run(10.0, [&] { return rig.v_mps() > speed_mps - 0.03; }));
    deaf.begin(rig);
    rig.by_hand = types::Twist2{};  // the operator lets go
    const double from_m = rig.body().path_m(), from_s = rig.now_s();
    ASSERT_TRUE(rig.run(8.0, [&] { return std::abs(rig.v_mps()) < 1e-3; })) << speed_mps;
    std::printf("swallows stops at %.1f m/s: stands after %.2f m, %.2f s\n", speed_mps,
                rig.body().path_m() - from_m, rig.now_s() - from_s);
    EXPECT_TRUE(has(rig.report().plausibility.doubts, Doubt::kDisobeys));
    rig.run(10.0);
    EXPECT_TRUE(has(rig.report().plausibility.doubts, Doubt::kDisobeys)) << "it stays in doubt";
    EXPECT_TRUE(rig.command().silence);
  }
}

TEST(PlausibilitySim, AScannerUpsideDownIsFoundAtTheFirstTurn) {
  DriveSetup setup;
  setup.start = {15.0, 4.0, 0.0};
  DriveRig rig(sim::scene(sim::hall_text()), setup);
  Matcher matcher(rig);
  matcher.upside_down = true;
  rig.match = matcher;
  rig.by_hand = types::Twist2{0.0, 1.0};
  const double from_s = rig.now_s();
  EXPECT_TRUE(rig.run(6.0, [&] { return has(rig.report().plausibility.doubts, Doubt::kMatchDisagrees); }));
  EXPECT_LT(rig.now_s() - from_s, 4.0);
}

}  // namespace
}  // namespace topo::test

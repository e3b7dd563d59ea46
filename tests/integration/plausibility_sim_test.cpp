// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Faults in which everything arrives, in form and in time, and is wrong: the base thread's step in lock-step
// with the simulated robot. A box appears a metre ahead after the fault has begun.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "tests/integration/fault_table.hpp"
#include "tests/integration/value_faults.hpp"
#include "tests/unit/sim/rooms.hpp"
#include "tests/unit/support/times.hpp"

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

/// Of one fault over all seeds, the worst.
struct Seen {
  double way_m = 0.0, time_s = 0.0;
  std::string says = "nothing", back;
};

/// The first standstill of 0.1 s after some motion; zero when nothing moved at all.
struct Standstill {
  double way_m = 0.0, time_s = 0.0;
  double since_s = -1.0;
  bool moved = false, stood = false;
  void look(double speed_mps, double from_m, double from_s) {
    constexpr double kStands_mps = 1e-3, kLongEnough_s = 0.1;
    if (stood) return;
    if (std::abs(speed_mps) > kStands_mps) {
      moved = true;
      since_s = -1.0;
    } else if (moved && since_s < 0.0) {
      since_s = time_s = from_s;
      way_m = from_m;
    }
    stood = since_s >= 0.0 && from_s - since_s > kLongEnough_s;
  }
};

struct Drive {
  std::unique_ptr<DriveRig> rig;
  double from_m = 0.0, from_s = 0.0, v_mps = 0.0;
};

/// When a fault begins, and how fast the robot may be.
struct Blow {
  bool at_start = false;
  double v_max_mps = 0.7;
};
/// The usual speed, and the most of a P3-DX, for empty buildings.
constexpr Blow kBlows[] = {{true, 0.7}, {false, 0.7}, {false, types::kP3dx.v_max_mps}};

std::string form_of(const Blow& blow) {
  return blow.at_start ? "values, from the start" : fmt::format("values, at {} m/s", blow.v_max_mps);
}

Drive begin(std::uint64_t seed, const Blow& blow, const ValueFault& lie) {
  DriveSetup setup;
  setup.v_max_mps = blow.v_max_mps;
  setup.start = {2.0, 4.0, 0.0};
  setup.seed = seed;
  Drive drive{std::make_unique<DriveRig>(sim::scene(sim::hall_text()), setup)};
  DriveRig& rig = *drive.rig;
  if (blow.at_start) lie.begin(rig);
  rig.go(straight());
  const double full_mps = rig.setup.limits.v_max_mps - 0.03;
  if (!blow.at_start) {
    EXPECT_TRUE(rig.run(10.0, [&] { return rig.v_mps() > full_mps && rig.now_s() > 3.0; }));
  }
  drive.from_m = rig.body().path_m();
  drive.from_s = rig.now_s();
  drive.v_mps = rig.v_mps();
  if (!blow.at_start) lie.begin(rig);
  return drive;
}

/// The fault is over: does it go on, and what does that need?
std::string how_it_comes_back(DriveRig& rig) {
  const auto goes_on = [&rig] { return rig.v_mps() > 0.3; };
  if (rig.run(10.0, goes_on)) return "by itself";
  rig.go(straight());
  if (rig.run(5.0, goes_on)) return "a new order";
  rig.estop_cleared = true;
  if (rig.run(5.0, goes_on)) return "clear-estop";
  rig.go(straight());
  return rig.run(10.0, goes_on) ? "clear-estop and a new order" : "not";
}

/// Reasons that are about what is wrong, and not about what stands in the way.
bool stops(motion::GateReason reason) {
  using R = motion::GateReason;
  return reason != R::kFree && reason != R::kLimited && reason != R::kSlowed && reason != R::kBlocked &&
         reason != R::kImplausible;
}

/// One fault with one seed, judged.
void suffer(const ValueFault& fault, const Blow& blow, std::uint64_t seed, Seen& worst) {
  const Drive drive = begin(seed, blow, fault);
  DriveRig& rig = *drive.rig;
  std::optional<sim::MovableId> box;
  Standstill standstill;
  plausibility::DoubtSet all;
  const double watched_s = 8.0 * blow.v_max_mps / 0.7;  // as the time to brake
  rig.run(fault.box_after_s + watched_s, [&] {
    const double since_s = rig.now_s() - drive.from_s;
    all |= rig.report().plausibility.doubts;
    standstill.look(rig.v_mps(), rig.body().path_m() - drive.from_m, since_s);
    if (!standstill.stood && stops(rig.report().reason)) worst.says = motion::to_text(rig.report().reason);
    if (box || since_s <= fault.box_after_s) return false;
    const auto added = rig.simulation().add_box_ahead(0, 1.0);
    EXPECT_TRUE(added.has_value());
    if (added) box = *added;
    return false;
  });
  EXPECT_EQ(rig.body().collisions(), 0U) << fault.name << ", " << form_of(blow) << ", seed " << seed;
  if (!fault.perhaps_doubted) {
    EXPECT_EQ(all.any(), fault.doubt.has_value()) << fault.name << ": " << plausibility::found_text(all);
  }
  if (fault.doubt) {
    EXPECT_TRUE(has(all, *fault.doubt)) << fault.name << ": " << plausibility::found_text(all);
  }
  heal(rig);
  if (box) {
    EXPECT_TRUE(rig.simulation().remove_obstacle(*box));
  }
  const std::string back = how_it_comes_back(rig);
  EXPECT_NE(back, "not") << fault.name << ", " << form_of(blow) << ", seed " << seed << ": "
                         << to_text(rig.report().mode) << ", " << to_text(rig.report().reason) << ", "
                         << plausibility::found_text(rig.report().plausibility.doubts) << ", at "
                         << rig.body().truth().x_m << " " << rig.body().truth().y_m << " "
                         << rig.body().truth().theta_rad;
  EXPECT_EQ(rig.body().collisions(), 0U) << fault.name << ", when it was over";
  EXPECT_TRUE(standstill.stood || !standstill.moved) << fault.name << " drove on";
  worst.way_m = std::max(worst.way_m, standstill.way_m);
  worst.time_s = std::max(worst.time_s, standstill.time_s);
  if (all.any()) worst.says = plausibility::found_text(all);
  if (worst.back.size() < back.size()) worst.back = back;
}

TEST(PlausibilitySim, NoFaultEndsInACollision) {
  std::vector<ValueFault> faults = lies();
  for (ValueFault& fault : plain_faults()) faults.push_back(std::move(fault));
  // Under AddressSanitizer each has one blow.
  constexpr bool kEveryBlow = test::times(1, 0) == 1;
  for (std::size_t f = 0; f < faults.size(); ++f) {
    const ValueFault& fault = faults[f];
    for (std::size_t b = 0; b < std::size(kBlows); ++b) {
      if (!kEveryBlow && b != f % std::size(kBlows)) continue;
      const Blow& blow = kBlows[b];
      Seen worst;
      for (int seed = 1; seed <= test::times(3, 1); ++seed)
        suffer(fault, blow, static_cast<std::uint64_t>(seed), worst);
      std::printf("%-48s %-22s %5.2f m %5.2f s  %s; back: %s\n", fault.name.c_str(), form_of(blow).c_str(),
                  worst.way_m, worst.time_s, worst.says.c_str(), worst.back.c_str());
      record({fault.name, form_of(blow),
              worst.time_s > 0.0 ? stands_after(worst.way_m, worst.time_s) : "does not move", worst.says,
              worst.back});
    }
  }
}

TEST(PlausibilitySim, ABaseThatSwallowsStopsIsStoppedByItsWatchdog) {
  for (const double speed_mps : {0.3, 0.7}) {
    DriveSetup setup;
    setup.start = {2.0, 4.0, 0.0};
    DriveRig rig(sim::scene(sim::hall_text()), setup);
    rig.by_hand = types::Twist2{speed_mps, 0.0};
    ASSERT_TRUE(rig.run(10.0, [&] { return rig.v_mps() > speed_mps - 0.03; }));
    rig.carry = swallow;
    rig.by_hand = types::Twist2{};  // the operator lets go
    const double from_m = rig.body().path_m(), from_s = rig.now_s();
    ASSERT_TRUE(rig.run(8.0, [&] { return std::abs(rig.v_mps()) < 1e-3; })) << speed_mps;
    const double way_m = rig.body().path_m() - from_m, time_s = rig.now_s() - from_s;
    std::printf("swallows stops at %.1f m/s: stands after %.2f m, %.2f s\n", speed_mps, way_m, time_s);
    EXPECT_TRUE(has(rig.report().plausibility.doubts, Doubt::kDisobeys));
    rig.run(10.0);
    EXPECT_TRUE(has(rig.report().plausibility.doubts, Doubt::kDisobeys)) << "it stays in doubt";
    EXPECT_TRUE(rig.command().silence);
    if (speed_mps < 0.7) continue;
    record({"base: swallows every command", "values, at 0.7 m/s, the operator stops",
            stands_after(way_m, time_s),
            std::string(plausibility::found_text(rig.report().plausibility.doubts)), "clear-estop"});
    heal(rig);
    rig.estop_cleared = true;
    rig.by_hand = types::Twist2{0.3, 0.0};
    EXPECT_TRUE(rig.run(5.0, [&] { return rig.v_mps() > 0.2; }));
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

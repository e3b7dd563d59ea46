// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/homes.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/core/team/generators.hpp"

namespace topo::team {
namespace {

using types::Vector2;

/// A dead end at x = 0; robots come from the east.
double from_the_east(const Vector2& start) { return 50.0 - start.x(); }

StatusMessage out(std::uint16_t robot, double start_x_m) {
  StatusMessage w;
  w.robot = robot;
  w.start = {start_x_m, 0.0};
  w.T_map_base = {50.0, 0.0, 0.0};
  w.way_map = {{49.0, 0.0}};
  return w;
}

StatusMessage home_at(std::uint16_t robot, double start_x_m, double x_m) {
  StatusMessage w = out(robot, start_x_m);
  w.home = Vector2(x_m, 0.0);
  w.T_map_base = {x_m, 0.0, 0.0};
  w.way_map.clear();
  return w;
}

std::optional<Vector2> home(const StatusMessage& self, const std::vector<StatusMessage>& mates,
                            const std::optional<Home>& present = {}, const StatusMessage* passing = nullptr) {
  std::vector<const StatusMessage*> messages;
  for (const StatusMessage& mate : mates) messages.push_back(&mate);
  const auto chosen = choose_home(self, messages, present, passing, from_the_east, 0.6);
  if (!chosen) return std::nullopt;
  return chosen->p_map;
}

TEST(ChooseHome, whoComesFirstGoesFarthestIn) {
  EXPECT_EQ(home(out(2, 3.0), {out(1, 1.5), out(3, 4.5)}), Vector2(1.5, 0.0));
  EXPECT_EQ(home(out(1, 1.5), {home_at(2, 3.0, 1.5), out(3, 4.5)}), Vector2(3.0, 0.0));
  EXPECT_EQ(home(out(1, 1.5), {}), Vector2(1.5, 0.0)) << "alone";
}

TEST(ChooseHome, ofTwoThatWantOneTheLowerIdKeepsIt) {
  StatusMessage a = out(1, 1.5), b = out(2, 3.0);
  a.home = b.home = Vector2(1.5, 0.0);
  EXPECT_EQ(home(a, {b}, Home{1, *a.home}), Vector2(1.5, 0.0));
  EXPECT_EQ(home(b, {a}, Home{1, *b.home}), Vector2(3.0, 0.0));
}

TEST(ChooseHome, staysWithItsChoice) {
  EXPECT_EQ(home(out(2, 3.0), {out(1, 1.5)}, Home{2, {3.0, 0.0}}), Vector2(3.0, 0.0));
}

TEST(ChooseHome, movesWithTheStartThatItIs) {
  EXPECT_EQ(home(out(2, 3.0), {out(1, 1.9)}, Home{1, {1.5, 0.0}}), Vector2(1.9, 0.0));
  EXPECT_EQ(home(out(2, 3.0), {}, Home{1, {1.5, 0.0}}), Vector2(1.5, 0.0)) << "its owner is silent";
}

TEST(ChooseHome, whoStandsInTheWayMovesUpAndThePassingOneGetsItsPlace) {
  // Robot 2 came home to 3.0 though 1.5 is farther in; 1 is bound for that.
  StatusMessage standing = home_at(2, 3.0, 3.0), passing = out(1, 1.5);
  passing.home = Vector2(1.5, 0.0);
  EXPECT_EQ(home(standing, {passing}, Home{2, {3.0, 0.0}}, &passing), Vector2(1.5, 0.0));
  // On its way there it keeps it, lower id or not, and the other keeps it, too, until it is there.
  StatusMessage moving = standing;
  moving.T_map_base = {2.3, 0.0, 0.0};
  moving.home = Vector2(1.5, 0.0);
  moving.way_map = {{2.0, 0.0}};
  EXPECT_EQ(home(moving, {passing}, Home{1, {1.5, 0.0}, 1}), Vector2(1.5, 0.0));
  EXPECT_EQ(home(moving, {passing}, Home{1, {1.5, 0.0}}), Vector2(3.0, 0.0)) << "had it not come by a swap";
  EXPECT_EQ(home(passing, {moving}, Home{1, {1.5, 0.0}}), Vector2(1.5, 0.0));
  moving.T_map_base = {1.6, 0.0, 0.0};
  moving.way_map.clear();
  EXPECT_EQ(home(passing, {moving}, Home{1, {1.5, 0.0}}), Vector2(3.0, 0.0));
}

TEST(ChooseHome, whoIsOnItsWayMovesUpForNobody) {
  StatusMessage passing = out(3, 4.5);
  passing.home = Vector2(1.5, 0.0);
  EXPECT_EQ(home(out(2, 3.0), {passing}, Home{2, {3.0, 0.0}}, &passing), Vector2(3.0, 0.0));
}

TEST(ChooseHome, whereTheRobotItselfStandsIsNotTaken) {
  StatusMessage a = out(1, 1.5), b = home_at(2, 3.0, 1.5);
  a.home = Vector2(1.5, 0.0);
  a.T_map_base = {2.0, 0.0, 0.0};
  EXPECT_EQ(home(b, {a}, Home{1, {1.5, 0.0}}), Vector2(1.5, 0.0));
}

TEST(StartBeside, isTheNearestWithinReach) {
  const StatusMessage mate = out(1, 1.5);
  const std::vector<const StatusMessage*> mates{&mate};
  StatusMessage self = out(2, 2.3);
  const auto owner_at = [&](double x_m) -> std::optional<std::uint16_t> {
    self.T_map_base = {x_m, 0.0, 0.0};
    const auto start = start_beside(self, mates, 0.6);
    return start ? std::optional(start->robot) : std::nullopt;
  };
  EXPECT_EQ(owner_at(1.8), 1);
  EXPECT_EQ(owner_at(2.0), 2) << "within 0.6 m of both";
  EXPECT_EQ(owner_at(2.8), 2);
  EXPECT_EQ(owner_at(3.0), std::nullopt);
  EXPECT_EQ(owner_at(0.8), std::nullopt);
}

TEST(ChooseHome, nobodyGoesWhereNoWayLeads) {
  const std::vector<const StatusMessage*> nobody;
  EXPECT_EQ(choose_home(
                out(2, 3.0), nobody, {}, nullptr, [](const Vector2&) { return HUGE_VAL; }, 0.6),
            std::nullopt);
}

TEST(ChooseHome, allComeHomeOneAfterTheOtherAndNobodyPassesAnybody) {
  EXPECT_TRUE(rc::check("any order of robots", [] {
    std::vector<StatusMessage> team;
    for (std::uint16_t id = 0; id < 5; ++id) team.push_back(out(id, 1.5 * (id + 1)));
    const std::vector<std::size_t> order = testing::shuffled(std::vector<std::size_t>{0, 1, 2, 3, 4});
    double last_x_m = 0.0;
    for (const std::size_t i : order) {
      std::vector<StatusMessage> mates = team;
      mates.erase(mates.begin() + static_cast<std::ptrdiff_t>(i));
      const auto chosen = home(team[i], testing::shuffled(mates));
      RC_ASSERT(chosen.has_value());
      RC_ASSERT(chosen->x() > last_x_m);
      last_x_m = chosen->x();
      team[i] = home_at(team[i].robot, team[i].start.x(), chosen->x());
    }
  }));
}

}  // namespace
}  // namespace topo::team

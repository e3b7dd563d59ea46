// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/team/right_of_way.hpp"
#include "tests/unit/core/exploration/toy_decision.hpp"

namespace topo::exploration {
namespace {

using std::chrono::seconds;
using types::Vector2;

/// A robot that stands in the corridor, and a mate that comes along it.
class MakingRoom : public ToyDecision {
 protected:
  [[nodiscard]] team::StatusMessage coming_mate() const {
    team::StatusMessage mate = mate_at(7, here() + Vector2(2.0, 0.0));
    for (double x = 2.0; x > -3.0; x -= 0.3) mate.way_map.push_back(here() + Vector2(x, 0.0));
    return mate;
  }
  [[nodiscard]] Intent exploring() const {
    Intent intent;
    intent.phase = Exploring{};
    intent.pursuit.number = 4;
    intent.pursuit.target = {11, 12};
    return intent;
  }
  [[nodiscard]] Intent give(const Situation& now, Intent intent) {
    return give_way(now, searches(), params_, std::move(intent));
  }
  /// The intent of one that makes room for the coming mate.
  [[nodiscard]] Intent making_way() {
    hear(coming_mate());
    return give(situation(), exploring());
  }
  void expect_goes_on(const Intent& after) const {
    EXPECT_TRUE(std::holds_alternative<Exploring>(after.phase));
    EXPECT_EQ(after.pursuit.target, exploring().pursuit.target) << "bound for where it was";
    EXPECT_EQ(after.pursuit.number, 6U);
  }
};

TEST_F(MakingRoom, AloneARobotDoesNotStandAside) {
  const Intent after = give(situation(), exploring());
  EXPECT_TRUE(std::holds_alternative<Exploring>(after.phase));
  EXPECT_EQ(after.pursuit.number, 4U);
}

TEST_F(MakingRoom, ARobotThatTurnsOnTheSpotGoesOutOfTheWayInstead) {
  hear(coming_mate());
  Intent turning = exploring();
  turning.pursuit.turn_to_rad = 1.0;
  const Intent after = give(situation(), turning);
  EXPECT_TRUE(std::holds_alternative<MakingWay>(after.phase));
  EXPECT_FALSE(after.pursuit.turn_to_rad);
}

TEST_F(MakingRoom, ARobotInAMatesWayGoesOutOfIt) {
  const Intent after = making_way();
  ASSERT_TRUE(std::holds_alternative<MakingWay>(after.phase));
  const auto& [passage, task] = std::get<MakingWay>(after.phase);
  EXPECT_EQ(passage.mate, 7U);
  EXPECT_EQ(passage.asked_at, here());
  EXPECT_EQ(passage.target, exploring().pursuit.target);
  EXPECT_TRUE(std::holds_alternative<Exploring>(task));
  EXPECT_EQ(after.pursuit.number, 5U) << "another route";
  EXPECT_EQ(after.reason, "makes room for robot 7");
  ASSERT_TRUE(after.pursuit.has_target);
  const Vector2 aside = map_.map().centre_of(after.pursuit.target);
  for (const Vector2& p : coming_mate().way_map)
    EXPECT_GE((p - aside).norm(), team::RightOfWayParams{}.room_m);
}

TEST_F(MakingRoom, AMateWithAnotherWayIsNotMadeRoomFor) {
  team::StatusMessage mate = coming_mate();
  for (Vector2& p : mate.way_map) p.x() += 5.0;
  hear(mate);
  EXPECT_TRUE(std::holds_alternative<Exploring>(give(situation(), exploring()).phase));
}

TEST_F(MakingRoom, TheTaskGoesOnWhenTheMatePassed) {
  const Intent aside = making_way();
  team::StatusMessage mate = coming_mate();
  mate.sequence = 2;
  mate.way_map.erase(mate.way_map.begin(), mate.way_map.end() - 4);  // beyond
  hear(mate);
  expect_goes_on(give(situation(), aside));
}

TEST_F(MakingRoom, TheTaskGoesOnWhenTheMateFellSilent) {
  const Intent aside = making_way();
  Situation later = situation();
  later.now += seconds(11);
  expect_goes_on(give(later, aside));
}

TEST_F(MakingRoom, AfterHalfAMinuteEachGoesItsWayForAsLong) {
  const Intent aside = making_way();
  const auto heard_later = [&](int t_s) {
    Situation later = situation();
    later.now += seconds(t_s);
    team::StatusMessage mate = coming_mate();
    mate.sequence = static_cast<std::uint64_t>(10 + t_s);
    roster_.take(mate, later.now);
    return later;
  };
  EXPECT_TRUE(std::holds_alternative<MakingWay>(give(heard_later(30), aside).phase));
  const Intent after = give(heard_later(31), aside);
  expect_goes_on(after);
  EXPECT_TRUE(std::holds_alternative<Exploring>(give(heard_later(60), after).phase));
  EXPECT_TRUE(std::holds_alternative<MakingWay>(give(heard_later(61), after).phase));
}

TEST_F(MakingRoom, StandingAsideCountsAsProgress) {
  Intent aside = making_way();
  aside.pursuit.last_progress = aside.pursuit.taken = types::Stamp{};
  const Intent after = give(situation(), aside);
  EXPECT_EQ(after.pursuit.last_progress, building_.now());
  EXPECT_EQ(after.pursuit.taken, building_.now());
  EXPECT_EQ(after.pursuit.number, aside.pursuit.number) << "the same route";
}

TEST_F(MakingRoom, AtHomeARobotMovesUpForAMateThatComesHome) {
  team::StatusMessage mate = coming_mate();
  mate.home = here() + Vector2(-3.0, 0.0);
  hear(mate);
  Intent home = exploring();
  home.phase = Returning{"explored", false};
  home.offer.home = team::Home{5, here()};
  EXPECT_TRUE(std::holds_alternative<Returning>(give(situation(), home).phase));
  home.offer.home->p_map = here() + Vector2(5.0, 0.0);
  EXPECT_TRUE(std::holds_alternative<MakingWay>(give(situation(), home).phase)) << "not at home yet";
}

}  // namespace
}  // namespace topo::exploration

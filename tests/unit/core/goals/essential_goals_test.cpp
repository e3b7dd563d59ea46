// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/essential_goals.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/goals/filters.hpp"
#include "core/goals/opening_check.hpp"
#include "core/goals/steering.hpp"
#include "tests/unit/core/goals/scene.hpp"
#include "tests/unit/core/places/drawn_map.hpp"

namespace topo::goals {
namespace {

using grid::CellState;
using places::DrawnMap;

/// A corridor of 2 m from x = 1 m on, closed there and open at x = 15 m.
DrawnMap corridor() {
  return DrawnMap(320, 160).room(20, 20, 300, 60).fill(300, 18, 302, 62, CellState::kUnknown);
}

/// The same with a door of 0.9 m at x = 8 m, through which a fan of a room was seen.
DrawnMap corridor_with_glimpse() {
  DrawnMap drawn = corridor();
  for (int y = 60; y < 110; ++y) drawn.free(151 - (y - 60) * 3 / 5, y, 169 + (y - 60) * 3 / 5, y + 1);
  return drawn;
}

int count(const GoalSet& set, Verdict verdict) {
  return static_cast<int>(std::count_if(set.rejected.begin(), set.rejected.end(),
                                        [&](const Goal& g) { return g.verdict == verdict; }));
}

TEST(EssentialGoals, OfACorridorSeenToItsMiddleIsOneAtItsEnd) {
  Scene scene(corridor());
  const auto at = [&](int x, int y) { return scene.map.centre_of({x, y}); };
  scene.continued = continued_walls(
      scene.map, std::vector<types::Segment>{{at(20, 19), at(300, 19)}, {at(20, 60), at(300, 60)}});
  const GoalSet set = scene.goals();
  ASSERT_EQ(set.goals.size(), 1U);
  EXPECT_EQ(set.goals[0].side, Side::kEast);
  EXPECT_NEAR(set.goals[0].opening_m, 2.0, 0.1);
  EXPECT_NEAR(set.goals[0].opening.x(), 15.0, 0.1);
  EXPECT_NEAR(set.goals[0].opening.y(), 2.0, 0.1);
  EXPECT_NEAR(set.goals[0].p_map.x(), 14.5, 0.6);
  EXPECT_NEAR(set.goals[0].chance, 0.65, 0.05) << "between walls that go on";
  EXPECT_EQ(set.rejected.size(), 3U) << "the other sides";
  EXPECT_EQ(count(set, Verdict::kNoOpening), 3);
}

TEST(EssentialGoals, OfARoomSeenThroughItsDoorAreNotLost) {
  const Scene scene(corridor_with_glimpse());
  const GoalSet set = scene.goals();
  const auto in_room =
      std::find_if(set.goals.begin(), set.goals.end(), [](const Goal& g) { return g.opening.y() > 3.1; });
  ASSERT_NE(in_room, set.goals.end());
  EXPECT_GE(in_room->opening_m, 1.0);
  EXPECT_GE(set.goals.size(), 2U) << "and the corridor's end";
  EXPECT_LE(set.goals.size(), 4U) << "a handful";
}

TEST(EssentialGoals, OfARoomWhoseCorridorWasDrivenAreNotVisited) {
  std::vector<std::vector<types::Vector2>> paths(1);
  for (double x = 2.0; x < 14.5; x += 0.3) paths[0].emplace_back(x, 2.0);
  const GoalSet set = Scene(corridor_with_glimpse()).goals(paths);
  EXPECT_TRUE(
      std::any_of(set.goals.begin(), set.goals.end(), [](const Goal& g) { return g.opening.y() > 3.1; }));
}

TEST(EssentialGoals, OfAClosedRoomAreNone) {
  const GoalSet set = Scene(DrawnMap(140, 120).room(20, 20, 120, 100)).goals();
  EXPECT_TRUE(set.goals.empty());
  EXPECT_EQ(set.rejected.size(), 4U);
}

TEST(EssentialGoals, ASideBesideAnotherPlaceIsInternal) {
  const DrawnMap drawn =
      DrawnMap(260, 140).room(20, 20, 120, 120).room(122, 20, 222, 120).free(120, 60, 122, 78);
  const Scene scene(drawn);
  ASSERT_EQ(scene.places.places.size(), 2U);
  EXPECT_TRUE(faces_another_place(scene.input(), 1, Side::kEast, {}));
  EXPECT_FALSE(faces_another_place(scene.input(), 1, Side::kWest, {}));
  EXPECT_EQ(count(scene.goals(), Verdict::kInternal), 2);
}

TEST(EssentialGoals, ASlitIsNoOpening) {
  DrawnMap drawn = DrawnMap(200, 120).room(20, 20, 180, 100).fill(100, 100, 108, 102, CellState::kFree);
  EXPECT_TRUE(Scene(drawn).goals().goals.empty()) << "0.4 m";
  drawn.free(92, 100, 112, 102);
  EXPECT_EQ(Scene(drawn).goals().goals.size(), 1U) << "1.0 m";
}

TEST(EssentialGoals, OfNothingAreNone) {
  EXPECT_TRUE(Scene(DrawnMap(30, 30)).goals().goals.empty());
  EXPECT_TRUE(Scene(DrawnMap(30, 30).occupied(0, 0, 30, 30)).goals().rejected.empty());
  EXPECT_TRUE(Scene(DrawnMap(30, 30).free(9, 9, 10, 10)).goals().goals.empty());
}

/// Whatever the map: a goal is a place where the robot can be.
TEST(EssentialGoals, AreFreeAndClear) {
  EXPECT_TRUE(rc::check([] {
    DrawnMap drawn(120, 100);
    drawn.free(4, 4, 116, 96);
    const int rectangles = *rc::gen::inRange(0, 20);
    for (int k = 0; k < rectangles; ++k) {
      const int x = *rc::gen::inRange(0, 118), y = *rc::gen::inRange(0, 98);
      drawn.fill(x, y, std::min(x + *rc::gen::inRange(1, 40), 120),
                 std::min(y + *rc::gen::inRange(1, 12), 100),
                 *rc::gen::element(CellState::kOccupied, CellState::kUnknown));
    }
    const Scene scene(drawn);
    const GoalSet set = scene.goals();
    for (const Goal& goal : set.goals) {
      const grid::CellIndex c = scene.map.cell_at(goal.p_map);
      RC_ASSERT(scene.map.state(c) == CellState::kFree);
      RC_ASSERT(scene.clearance_m[scene.map.index(c)] >= 0.3F - 1e-6F);
      RC_ASSERT(goal.opening_m >= 0.6 - 1e-6);
      RC_ASSERT(goal.verdict == Verdict::kAccepted);
      RC_ASSERT(goal.place >= 1 && goal.place <= scene.places.places.size());
    }
    for (const Goal& goal : set.rejected) RC_ASSERT(goal.verdict != Verdict::kAccepted);
  }));
}

TEST(EssentialGoals, DoNotDependOnTheOrderOfThePaths) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene(random_room(120));
    auto paths = random_paths(5.0);
    const GoalSet set = scene.goals(paths);
    std::ranges::reverse(paths);
    const GoalSet again = scene.goals(paths);
    const auto check_same = [](const std::vector<Goal>& a, const std::vector<Goal>& b) {
      RC_ASSERT(a.size() == b.size());
      for (std::size_t k = 0; k < a.size(); ++k)
        RC_ASSERT(a[k].p_map == b[k].p_map && a[k].verdict == b[k].verdict && a[k].chance == b[k].chance);
    };
    check_same(set.goals, again.goals);
    check_same(set.rejected, again.rejected);
  }));
}

TEST(EssentialGoals, EverySideOfEveryPlaceHasACandidate) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene(random_room(120));
    const GoalSet set = scene.goals(random_paths(5.0));
    std::vector<int> found(4 * scene.places.places.size(), 0);
    for (const std::vector<Goal>* const some : {&set.goals, &set.rejected}) {
      for (const Goal& goal : *some) ++found.at(4U * (goal.place - 1U) + static_cast<std::size_t>(goal.side));
      const auto key = [](const Goal& g) { return std::pair(g.place, g.side); };
      RC_ASSERT(std::ranges::is_sorted(*some, {}, key));
    }
    RC_ASSERT(std::ranges::count(found, 0) == 0);
  }));
}

bool any_leads_to_unknown(const DrawnMap& drawn) {
  const Scene scene(drawn);
  const auto openings = find_openings(scene.input(), {});
  return std::any_of(openings.begin(), openings.end(),
                     [&](const Opening& o) { return leads_to_unknown(scene.map, o.cells, {}); });
}

TEST(Filters, APocketIsNotSpaceToEnter) {
  // Unknown space at a wall: 2 x 2 m behind a cupboard, then 6 x 6 m.
  const auto pocket = [](int side) {
    return DrawnMap(260, 260)
        .room(20, 20, 240, 240)
        .fill(240 - side, 40, 240, 40 + side, CellState::kUnknown);
  };
  EXPECT_FALSE(any_leads_to_unknown(pocket(40)));
  EXPECT_TRUE(any_leads_to_unknown(pocket(120)));
}

TEST(Filters, WhereTheRobotDoesNotFitThroughIsNoSpaceToEnter) {
  // Posts in the unknown behind the open end of the corridor, 0.8 m apart, then 0.5 m.
  const auto behind_posts = [](int free_cells) {
    DrawnMap drawn = corridor();
    for (int y = 20; y < 60; y += free_cells + 1) drawn.occupied(302, y, 303, y + 1);
    return drawn;
  };
  EXPECT_TRUE(any_leads_to_unknown(corridor()));
  EXPECT_TRUE(any_leads_to_unknown(behind_posts(16)));
  EXPECT_FALSE(any_leads_to_unknown(behind_posts(10)));
}

TEST(Filters, OneNodeIsOneGoals) {
  const Scene scene(corridor());
  const auto openings = find_openings(scene.input(), {});
  ASSERT_EQ(openings.size(), 1U);
  FreeNodes nodes(scene.skeleton);
  const auto left = [&] {
    std::size_t count = 0;
    nodes.for_each_in_rows(INT32_MIN, INT32_MAX, [&](std::uint32_t, const auto&) { ++count; });
    return count;
  };
  ASSERT_EQ(left(), scene.skeleton.nodes.size());
  const auto stand = nearest_room(scene.input(), openings[0].cells, {});
  ASSERT_TRUE(stand);
  const types::Vector2 first = steer(scene.input(), openings[0], *stand, {}, nodes);
  const types::Vector2 second = steer(scene.input(), openings[0], *stand, {}, nodes);
  EXPECT_LT(left(), scene.skeleton.nodes.size());
  EXPECT_NE(first, second);
}

TEST(Filters, AnOpeningBehindANarrowFanIsSeenFromItsBeginning) {
  // A slot of 0.5 m, 4 m long, that widens to 1 m: nobody stands in it.
  DrawnMap drawn = DrawnMap(320, 300).room(20, 20, 300, 100);
  drawn.free(150, 100, 160, 180).free(145, 180, 165, 182);
  const Scene scene(drawn);
  Opening opening;
  opening.middle = static_cast<std::uint32_t>(scene.map.index(scene.map.cell_at({7.75, 9.08})));
  opening.cells = {opening.middle};
  const auto stand = nearest_room(scene.input(), opening.cells, {});
  ASSERT_TRUE(stand);
  FreeNodes nodes(scene.skeleton);
  const types::Vector2 p = steer(scene.input(), opening, *stand, {}, nodes);
  EXPECT_NEAR(p.x(), 7.75, 0.5);
  EXPECT_LT(p.y(), 5.0);
  EXPECT_GT(p.y(), 4.3);
  GoalParams impatient;
  impatient.room_reach_m = 3.0;
  EXPECT_FALSE(nearest_room(scene.input(), opening.cells, impatient));
}

/// A room of 8 x 6 m, and at its upper wall the shadow of a cupboard, 2.2 m wide and 2 m deep, in which the
/// wall was not seen.
TEST(EssentialGoals, OfAShadowBeforeAWallThatGoesOnAreNone) {
  DrawnMap drawn = DrawnMap(200, 160).room(20, 20, 180, 140).fill(70, 100, 114, 142, CellState::kUnknown);
  drawn.occupied(70, 98, 114, 100);
  Scene scene(drawn);
  EXPECT_FALSE(scene.goals().goals.empty()) << "the shadow's end is not known";
  const double wall_y_m = scene.map.centre_of({0, 140}).y();
  const auto x_m = [&](int x) { return scene.map.centre_of({x, 0}).x(); };
  scene.continued =
      continued_walls(scene.map, std::vector<types::Segment>{{{x_m(20), wall_y_m}, {x_m(69), wall_y_m}},
                                                             {{x_m(114), wall_y_m}, {x_m(180), wall_y_m}}});
  const GoalSet set = scene.goals();
  EXPECT_TRUE(set.goals.empty());
  EXPECT_GE(count(set, Verdict::kUnlikely) + count(set, Verdict::kNoOpening), 1);
}

TEST(Filters, APlaceIsVisitedByWhoWasThere) {
  Goal goal;
  goal.p_map = {5.0, 5.0};
  goal.opening_m = 0.8;
  using Ways = std::vector<std::vector<types::Vector2>>;
  const Ways start = {{{5.0, 5.0}, {5.5, 5.0}, {6.5, 5.0}, {7.5, 5.0}}};
  const Ways past = {{{3.5, 5.1}, {4.2, 5.1}, {5.0, 5.1}, {5.7, 5.1}, {6.5, 5.1}}};
  const Ways either_side = {{{2.5, 5.0}, {4.2, 5.0}}, {{5.8, 5.0}, {7.5, 5.0}}};
  EXPECT_TRUE(is_visited(goal, start, {}));
  goal.opening_m = 2.0;
  EXPECT_FALSE(is_visited(goal, start, {})) << "behind the robot's back when it started";
  EXPECT_TRUE(is_visited(goal, past, {}));
  EXPECT_FALSE(is_visited(goal, either_side, {})) << "two robots, and nobody went from the one to the other";
  EXPECT_FALSE(is_visited(goal, {}, {}));
}

}  // namespace
}  // namespace topo::goals

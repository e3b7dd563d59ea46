// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/right_of_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/grid/distance.hpp"
#include "tests/unit/core/grid/maps.hpp"
#include "tests/unit/core/team/generators.hpp"

namespace topo::team {
namespace {

using grid::CellState;
using types::Vector2;

StatusMessage robot(std::uint16_t id, const Vector2& at, const std::vector<Vector2>& way = {}) {
  StatusMessage w;
  w.robot = id;
  w.T_map_base = {at.x(), at.y(), 0.0};
  w.duty = Duty::kAble;
  w.way_map = way;
  return w;
}

std::vector<Vector2> line(const Vector2& from, const Vector2& to) {
  std::vector<Vector2> points;
  for (int i = 0; i <= 20; ++i) points.push_back(from + (to - from) * (i / 20.0));
  return points;
}

bool makes_room(const StatusMessage& a, const StatusMessage& b) {
  return who_needs_room(a, std::vector<const StatusMessage*>{&b}) != nullptr;
}

TEST(Precedence, ofTwoHeadOnTheHigherIdMakesRoom) {
  const StatusMessage a = robot(1, {0.0, 0.0}, line({0.0, 0.0}, {4.0, 0.0}));
  const StatusMessage b = robot(2, {2.0, 0.0}, line({2.0, 0.0}, {-4.0, 0.0}));
  EXPECT_FALSE(makes_room(a, b));
  EXPECT_TRUE(makes_room(b, a));
}

TEST(Precedence, whoStandsInTheWayMakesRoomWhateverItsId) {
  const StatusMessage a = robot(1, {2.0, 0.0});
  const StatusMessage b = robot(2, {0.0, 0.0}, line({0.0, 0.0}, {4.0, 0.0}));
  EXPECT_TRUE(makes_room(a, b));
  EXPECT_FALSE(makes_room(b, a));
}

StatusMessage heading(StatusMessage message, double theta_rad) {
  message.T_map_base.theta_rad = theta_rad;
  return message;
}

constexpr double kFresh_s = 0.4;

TEST(SlowsFor, bothOfTwoHeadOnAndNoneOfAMateThatStands) {
  const StatusMessage a = robot(1, {0.0, 0.0}, line({0.0, 0.0}, {4.0, 0.0}));
  const StatusMessage b = heading(robot(2, {2.2, 0.0}, line({2.2, 0.0}, {-4.0, 0.0})), M_PI);
  EXPECT_TRUE(slows_for(a, b, kFresh_s));
  EXPECT_TRUE(slows_for(b, a, kFresh_s));
  EXPECT_FALSE(slows_for(a, robot(2, {2.2, 0.0}), kFresh_s)) << "the scanner sees it where it is";
  EXPECT_FALSE(slows_for(a, robot(2, {4.0, 0.0}, line({4.0, 0.0}, {0.0, 0.0})), kFresh_s)) << "far";
}

TEST(SlowsFor, whoIsBehindOfTwoWithOneWay) {
  const StatusMessage first = robot(2, {1.0, 0.5}, line({1.0, 0.5}, {6.0, 0.5}));
  const StatusMessage second = robot(1, {0.0, 0.0}, line({0.0, 0.0}, {6.0, 0.0}));
  EXPECT_FALSE(slows_for(first, second, kFresh_s));
  EXPECT_TRUE(slows_for(second, first, kFresh_s));
}

TEST(SlowsFor, ofTwoAbreastTheHigherId) {
  const StatusMessage left = robot(1, {0.1, 0.9}, line({0.1, 0.9}, {6.0, 0.9}));
  const StatusMessage right = robot(2, {0.0, 0.0}, line({0.0, 0.0}, {6.0, 0.0}));
  EXPECT_FALSE(slows_for(left, right, kFresh_s));
  EXPECT_TRUE(slows_for(right, left, kFresh_s));
}

TEST(SlowsFor, aMateMayBeAnywhereItCanHaveGoneSinceItWasHeardOf) {
  const StatusMessage self = robot(1, {0.0, 0.0}, line({0.0, 0.0}, {4.0, 0.0}));
  const StatusMessage behind = robot(2, {-1.5, 0.0}, line({-1.5, 0.0}, {4.0, 0.0}));
  EXPECT_FALSE(slows_for(self, behind, kFresh_s));
  EXPECT_TRUE(slows_for(self, behind, 5.0));
  const StatusMessage far = robot(2, {4.0, 0.0}, line({4.0, 0.0}, {0.0, 0.0}));
  EXPECT_FALSE(slows_for(self, far, kFresh_s));
  EXPECT_TRUE(slows_for(self, far, 5.0));
}

TEST(SlowsFor, neverNeitherOfTwoThatComeNearer) {
  const std::vector<Vector2> on{{0.0, 0.0}};
  const StatusMessage self = robot(1, {0.0, 0.0}, on);
  int nearer = 0;
  for (double x = -1.4; x <= 1.4; x += 0.1) {
    for (double y = -1.4; y <= 1.4; y += 0.1) {
      for (double theta_rad = 0.0; theta_rad < 6.2; theta_rad += 0.1) {
        const StatusMessage mate = heading(robot(2, {x, y}, on), theta_rad);
        const Vector2 closing = Vector2(1.0, 0.0) - Vector2(std::cos(theta_rad), std::sin(theta_rad));
        if (closing.dot(Vector2(x, y)) < 1e-6) continue;
        ++nearer;
        ASSERT_TRUE(slows_for(self, mate, 0.0) || slows_for(mate, self, 0.0))
            << x << ' ' << y << ' ' << theta_rad;
      }
    }
  }
  EXPECT_GT(nearer, 10000);
}

TEST(Precedence, nobodyMakesRoomForOneThatIsBehindFarOrBesideIt) {
  const StatusMessage ahead = robot(2, {2.0, 0.0}, line({2.0, 0.0}, {6.0, 0.0}));
  EXPECT_FALSE(makes_room(ahead, robot(1, {0.0, 0.0}, line({0.0, 0.0}, {6.0, 0.0})))) << "it follows";
  const StatusMessage back = robot(2, {5.0, 0.0}, line({5.0, 0.0}, {0.0, 0.0}));
  EXPECT_FALSE(makes_room(back, robot(1, {0.0, 0.0}, line({0.0, 0.0}, {6.0, 0.0})))) << "5 m away";
  EXPECT_FALSE(makes_room(robot(2, {2.0, 1.2}), robot(1, {0.0, 0.0}, line({0.0, 0.0}, {6.0, 0.0}))));
}

TEST(Precedence, neverBothMakeRoomForEachOther) {
  EXPECT_TRUE(rc::check("and of two that are in each other's way one does", [] {
    const auto point = [] { return Vector2(*rc::gen::inRange(0, 5) * 0.7, *rc::gen::inRange(0, 5) * 0.7); };
    const auto way = [&](const Vector2& at) {
      return *rc::gen::arbitrary<bool>() ? line(at, point()) : std::vector<Vector2>{};
    };
    const Vector2 at_a = point(), at_b = point();
    const StatusMessage a = robot(3, at_a, way(at_a)), b = robot(8, at_b, way(at_b));
    RC_ASSERT(!(makes_room(a, b) && makes_room(b, a)));
  }));
}

/// A corridor 1.2 m wide with a niche to the north, 2 m wide, between x = 4 and 6 m.
grid::DenseMap corridor_with_niche() {
  grid::DenseMap map = grid::filled_map(200, 80, CellState::kOccupied);
  for (int x = 1; x < 199; ++x) {
    for (int y = 1; y < 25; ++y) map.cells[map.index({x, y})] = CellState::kFree;
  }
  for (int x = 80; x < 120; ++x) {
    for (int y = 25; y < 70; ++y) map.cells[map.index({x, y})] = CellState::kFree;
  }
  return map;
}

TEST(RoomBeside, isInTheNicheOfACorridor) {
  const grid::DenseMap map = corridor_with_niche();
  const auto clearance = clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  const Vector2 here(7.0, 0.6);
  const auto field = grid::travel_field(map, clearance, map.cell_at(here), {});
  const StatusMessage mate = robot(1, {9.0, 0.6}, line({9.0, 0.6}, {1.0, 0.6}));
  const std::vector<const StatusMessage*> mates{&mate};
  const auto cell = room_beside(map, field, mate, mates, 8.0);
  ASSERT_TRUE(cell.has_value());
  const Vector2 p = map.centre_of(*cell);
  EXPECT_GE(p.y(), 0.6 + 0.9);
  EXPECT_GT(p.x(), 4.0);
  EXPECT_LT(p.x(), 6.0);
  EXPECT_LT(p.y(), 2.2) << "and no deeper than it must be";

  const StatusMessage other = robot(2, {5.0, 1.8});
  const std::vector<const StatusMessage*> both{&mate, &other};
  const auto deeper = room_beside(map, field, mate, both, 8.0);
  ASSERT_TRUE(deeper.has_value());
  EXPECT_GE((map.centre_of(*deeper) - Vector2(5.0, 1.8)).norm(), 0.9) << "somebody stands there already";
  EXPECT_EQ(room_beside(map, field, mate, mates, 1.0), std::nullopt) << "not so near";
}

TEST(RoomBeside, isNoPlaceTooTightToTurnIn) {
  const grid::DenseMap map = corridor_with_niche();
  const auto clearance = clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  const grid::TravelRules wide_robot{.radius_m = 1.5, .tight_m = 0.297, .tightness = 0.0};
  const auto field = grid::travel_field(map, clearance, map.cell_at({7.0, 0.6}), wide_robot);
  const StatusMessage mate = robot(1, {9.0, 0.6}, line({9.0, 0.6}, {1.0, 0.6}));
  const std::vector<const StatusMessage*> mates{&mate};
  EXPECT_EQ(room_beside(map, field, mate, mates, 8.0), std::nullopt);
}

}  // namespace
}  // namespace topo::team

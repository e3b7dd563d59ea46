// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/here_first.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/exploration/toy_decision.hpp"

namespace topo::exploration {
namespace {

using types::Polygon;
using types::Vector2;

Polygon around(const Vector2& p, double half_m) {
  return {p + Vector2(-half_m, -half_m), p + Vector2(half_m, -half_m), p + Vector2(half_m, half_m),
          p + Vector2(-half_m, half_m)};
}

class HereFirst : public ToyDecision {
 protected:
  [[nodiscard]] Intent explored(const std::vector<Polygon>& first, Intent intent) {
    Situation now = situation();
    now.here_first = first;
    return explore(now, searches(), params_, std::move(intent));
  }
  [[nodiscard]] Intent begun() const {
    Intent intent;
    intent.sweep.sweep = FinalSweep(params_.final_sweep);
    return begin_mission(std::move(intent), Order::kExplore, building_.now());
  }
};

TEST(IsWithin, AnAreaAndWhatIsBesideIt) {
  const Polygon area = around({0.0, 0.0}, 1.0);
  EXPECT_TRUE(types::is_within(area, {0.0, 0.0}, 0.0));
  EXPECT_TRUE(types::is_within(area, {1.4, 0.0}, 0.5));
  EXPECT_FALSE(types::is_within(area, {1.6, 0.0}, 0.5));
}

TEST(HereFirstAreas, TheCandidatesInsideKeepTheirRows) {
  Judged all;
  for (const double x_m : {0.0, 5.0, 10.0}) {
    Candidate candidate;
    candidate.goal.p_map = candidate.goal.opening = {x_m, 0.0};
    all.candidates.push_back(candidate);
    all.table.row.emplace_back(all.table.row.size());
  }
  const std::vector<Polygon> areas{around({5.0, 0.0}, 1.0), around({11.4, 0.0}, 1.0)};
  const Judged first = here_first(all, areas);
  ASSERT_EQ(first.candidates.size(), 2U);
  EXPECT_EQ(first.table.row[0], 1U);
  EXPECT_EQ(first.table.row[1], 2U);
  EXPECT_TRUE(here_first(all, {}).candidates.empty());
}

TEST_F(HereFirst, AGoalInTheAreaIsTakenWhicheverItIs) {
  const std::vector<goals::Goal> open = explored({}, begun()).outlook.open_goals;
  ASSERT_GE(open.size(), 2U) << "there is something to choose";
  for (const goals::Goal& goal : open) {
    const Polygon area = around(place_for_team(goal), 0.3);
    const Intent intent = explored({area}, begun());
    ASSERT_TRUE(intent.pursuit.goal.has_value());
    EXPECT_TRUE(types::is_within(area, place_for_team(*intent.pursuit.goal), kBesideArea_m));
    EXPECT_TRUE(has_note(intent, "taken: "));
    EXPECT_NE(intent.reason.find("in an area that comes first"), std::string::npos) << intent.reason;
    EXPECT_EQ(intent.outlook.open_goals.size(), open.size()) << "the others stay open";
  }
}

TEST_F(HereFirst, TheGoalInHandIsLeftForIt) {
  const Intent before = explored({}, begun());
  ASSERT_TRUE(before.pursuit.goal.has_value());
  for (const goals::Goal& goal : before.outlook.open_goals) {
    const Vector2& other = place_for_team(goal);
    if ((other - place_for_team(*before.pursuit.goal)).norm() < 3.0) continue;
    const Intent after = explored({around(other, 0.3)}, before);
    EXPECT_TRUE(has_note(after, "left for one that comes first"));
    EXPECT_LT((place_for_team(*after.pursuit.goal) - other).norm(), 1.5);
    return;
  }
  FAIL() << "no other goal";
}

TEST_F(HereFirst, AnAreaInWhichNothingIsOpenChangesNothing) {
  const Intent without = explored({}, begun()), with = explored({around({500.0, 500.0}, 1.0)}, begun());
  ASSERT_TRUE(without.pursuit.goal && with.pursuit.goal);
  EXPECT_EQ(with.pursuit.goal->p_map, without.pursuit.goal->p_map);
  EXPECT_EQ(with.reason, without.reason);
  EXPECT_EQ(with.offer.bids.size(), without.offer.bids.size());
}

}  // namespace
}  // namespace topo::exploration

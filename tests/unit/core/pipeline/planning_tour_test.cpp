// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Which goal a robot that stands is bound for: when it leaves one for another, and when one it was at is
// a goal again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/goals/frontiers.hpp"
#include "core/goals/opening_chance.hpp"
#include "tests/unit/core/pipeline/toy_building.hpp"

namespace topo::pipeline {
namespace {

/// A hall that ends behind the robot beyond what it sees, and ahead of it, on its left, a passage of three
/// metres behind a shut door: two gaps, and no essential goal.
class HallAndPassage {
 public:
  /// `ahead`: from the robot to the passage, in characters.
  HallAndPassage(std::size_t ahead, double range_m, PlannerParams params)
      : passage_(kStart + ahead), building_(floor(), range_m), state_(without_essential(std::move(params))) {}

  void open_the_door() {
    for (std::size_t i = 0; i < kWidth; ++i)
      building_.open(static_cast<int>(passage_ + i), static_cast<int>(kRows - 1 - kDoorRow));
  }
  const PlanningReport& period() {
    out_ = building_.run_period(state_, {1, Order::kExplore, false, {0.0, 0.0}}, 0.0);
    return *out_.report;
  }
  [[nodiscard]] bool goes_to_the_passage() const {
    EXPECT_TRUE(out_.report->goal.has_value());
    return out_.report->goal && is_passage(*out_.report->goal);
  }
  [[nodiscard]] bool is_passage(const goals::Goal& goal) const {
    return goal.p_map.x() > building_.robot().x();
  }
  [[nodiscard]] types::Stamp now() const { return building_.now(); }
  [[nodiscard]] types::Vector2 robot() const { return building_.robot(); }

 private:
  static constexpr std::size_t kStart = 90, kWidth = 12, kRows = 45, kDoorRow = 26;

  static PlannerParams without_essential(PlannerParams params) {
    params.analysis.goals.opening_min_m = 100.0;
    return params;
  }
  [[nodiscard]] std::vector<std::string> floor() const {
    const std::size_t end = passage_ + kWidth;
    std::vector<std::string> rows(kRows, std::string(end + 1, '#'));
    for (std::size_t y = kDoorRow + 1; y < kRows - 2; ++y) rows[y].replace(1, end - 1, end - 1, ' ');
    for (std::size_t y = 5; y < kDoorRow; ++y) rows[y].replace(passage_, kWidth, kWidth, ' ');
    rows[kDoorRow + 4][kStart] = 'S';
    return rows;
  }

  std::size_t passage_;
  ToyBuilding building_;
  PlanningState state_;
  PlanningOutput out_;
};

/// Bound for the end of the hall, does the robot leave it for the passage when its door is opened?
bool leaves_for_the_passage(std::size_t ahead, double range_m, double switch_share,
                            double leads_on_m2 = 4.0) {
  PlannerParams params;
  params.explore.tour.switch_share = switch_share;
  params.explore.tour.leads_on_m2 = leads_on_m2;
  HallAndPassage scene(ahead, range_m, params);
  for (int i = 0; i < 4; ++i) {
    scene.period();
    EXPECT_FALSE(scene.goes_to_the_passage());
  }
  scene.open_the_door();
  for (int i = 0; i < 6; ++i) scene.period();
  EXPECT_EQ(scene.period().open_goals.size(), 2U);
  return scene.goes_to_the_passage();
}

// The way to the end of the hall costs 9.6 m; the tour that begins with the passage is 4 to 5 m cheaper.
TEST(SwitchShare, aGoalIsLeftForATourThatSavesThatShareOfTheWayToIt) {
  EXPECT_TRUE(leaves_for_the_passage(4, 6.0, exploration::TourParams{}.switch_share));
  EXPECT_TRUE(leaves_for_the_passage(4, 6.0, 0.38));
  EXPECT_FALSE(leaves_for_the_passage(4, 6.0, 0.6));
}

// Here it is about as much of 15.9 m, a smaller share.
TEST(SwitchShare, theFartherTheGoalTheMoreMetresAnotherTourHasToSave) {
  EXPECT_TRUE(leaves_for_the_passage(32, 12.0, exploration::TourParams{}.switch_share));
  EXPECT_FALSE(leaves_for_the_passage(32, 12.0, 0.38));
}

TEST(GapWorth, isByTheChanceThatItLeadsOn) {
  EXPECT_FALSE(leaves_for_the_passage(4, 6.0, 0.5, 0.0));
  EXPECT_TRUE(leaves_for_the_passage(4, 6.0, 0.5, 10.0)) << "more is unknown behind the passage";
}

TEST(GapChance, isByTheSpaceThatIsUnknownBehindIt) {
  HallAndPassage scene(4, 6.0, {});
  scene.open_the_door();
  for (int i = 0; i < 4; ++i) scene.period();
  const PlanningReport& report = scene.period();
  const analysis::Analysis& analysed = *report.analysis;
  ASSERT_EQ(report.open_goals.size(), 2U);
  for (const goals::Goal& gap : report.open_goals) {
    ASSERT_EQ(gap.behind_m2, HUGE_VAL);
    const auto away_m = [&](const goals::Frontier& f) { return (f.centroid - gap.opening).norm(); };
    const auto frontiers = goals::find_frontiers(analysed.map);
    const goals::Frontier& frontier = *std::ranges::min_element(frontiers, {}, away_m);
    ASSERT_LT(away_m(frontier), 0.1);
    const goals::GoalParams params;
    const double chance = goals::chance_to_lead_on(
        goals::space_behind(analysed.map, frontier.cells, analysed.continued, params.behind_m),
        params.behind_m);
    EXPECT_GT(chance, 0.2);
    EXPECT_NEAR(gap.chance, chance, 0.02);
  }
}

TEST(VisitedGoals, visitedGoalsAreNotTakenForWantOfOthers) {
  PlannerParams params;
  params.explore.pursuit.goal_reached_m =
      20.0;  // the passage and the end of the hall from where the robot stands
  params.explore.final_sweep.promise_min = 1.0;
  HallAndPassage scene(4, 6.0, params);
  scene.open_the_door();
  const types::Stamp begun = scene.now();
  while (scene.period().activity != Activity::kReturning && scene.now() < begun + std::chrono::seconds(20)) {
  }
  const PlanningReport& report = scene.period();
  EXPECT_EQ(report.reason, "explored: no goal is left in reach");
  EXPECT_EQ(report.deferred.size(), 2U);
  for (const exploration::DeferredGoal& goal : report.deferred) {
    EXPECT_TRUE(goal.visited);
    EXPECT_TRUE(goal.is_for_good());
  }
}

TEST(VisitedGoals, withoutFinalSweepVisitedGoalsComeBackInTime) {
  using std::chrono::seconds;
  PlannerParams params;
  params.explore.strategy = exploration::Strategy::kNearestFrontier;
  params.explore.pursuit.visited_s = 10.0;
  params.explore.pursuit.give_up_s = 1000.0;
  params.explore.pursuit.goal_reached_m = 4.0;  // in front of the passage, and not at the end of the hall
  HallAndPassage scene(4, 6.0, params);
  scene.open_the_door();
  types::Stamp visited = scene.now();
  while (scene.period().deferred.empty() && scene.now() < visited + seconds(60)) {
  }
  const PlanningReport* report = &scene.period();
  ASSERT_EQ(report->deferred.size(), 1U);
  EXPECT_TRUE(report->deferred.front().visited);
  visited = report->deferred.front().until - seconds(10);
  EXPECT_LE(visited, report->stamp);
  EXPECT_GE(visited, report->stamp - seconds(1));
  const auto is_open = [&] {
    return std::any_of(report->open_goals.begin(), report->open_goals.end(),
                       [&](const goals::Goal& goal) { return scene.is_passage(goal); });
  };
  for (; report->stamp < visited + seconds(10); report = &scene.period())
    EXPECT_FALSE(is_open()) << types::to_seconds(report->stamp - visited);
  while (!is_open() && report->stamp < visited + seconds(12)) report = &scene.period();
  EXPECT_TRUE(is_open());
}

}  // namespace
}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/mapping_step.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "core/grid/occupancy_grid.hpp"
#include "core/slam/map_builder.hpp"
#include "tests/mocks/flat_world.hpp"

namespace topo::pipeline {
namespace {

using std::chrono::milliseconds;
using types::Se2;
using types::Stamp;

types::Odometry odometry_at(int ms, const Se2& pose) {
  return {Stamp{milliseconds(ms)}, types::Transform2<types::Odom, types::Base>(pose), {}};
}

types::Scan scan_at(int ms, const Se2& pose) {
  std::mt19937 random(static_cast<unsigned>(ms));
  return mocks::take_scan(mocks::two_rooms(), pose, Stamp{milliseconds(ms)}, {541, 4.7, 30.0, 0.01}, random);
}

/// The robot's true place, 0.5 m/s along x.
Se2 truth_at(int ms) { return {2.0 + 0.0005 * ms, 3.0, 0.0}; }

TEST(MappingStep, AScanWaitsForTheOdometryAfterIt) {
  MappingState state{slam::MapperParams{}};
  const types::Odometry first = odometry_at(0, {}), second = odometry_at(100, {0.05, 0.0, 0.0});
  const types::Scan scan = scan_at(50, truth_at(50));
  EXPECT_TRUE(mapping_step(state, {{&first, 1}, &scan, nullptr}).matches.empty());
  const MappingOutput output = mapping_step(state, {{&second, 1}, nullptr, nullptr});
  ASSERT_EQ(output.matches.size(), 1U);
  EXPECT_TRUE(output.keyframe_added);
  EXPECT_EQ(output.matches[0].stamp, Stamp{milliseconds(50)});
}

TEST(MappingStep, ButNotForEver) {
  MappingState state{slam::MapperParams{}};
  const types::Odometry only = odometry_at(0, {});
  const types::Scan first = scan_at(50, truth_at(50)), later = scan_at(250, truth_at(250));
  EXPECT_TRUE(mapping_step(state, {{&only, 1}, &first, nullptr}).matches.empty());
  EXPECT_EQ(mapping_step(state, {{}, &later, nullptr}).matches.size(), 1U) << "the first has waited 200 ms";
}

TEST(MappingStep, WithoutAnyOdometryScansAreCountedNotPlaced) {
  MappingState state{slam::MapperParams{}};
  const types::Scan scan = scan_at(50, truth_at(50));
  EXPECT_TRUE(mapping_step(state, {{}, &scan, nullptr}).matches.empty());
  EXPECT_EQ(state.losses().without_odometry, 1U);
  EXPECT_TRUE(state.finish().matches.empty());
}

TEST(MappingStep, ABacklogIsBoundedAndCounted) {
  MappingState state{slam::MapperParams{}};
  const types::Odometry only = odometry_at(0, {});
  (void)mapping_step(state, {{&only, 1}, nullptr, nullptr});
  for (int i = 0; i < 40; ++i) {
    const types::Scan scan = scan_at(10 + i, truth_at(10));
    (void)mapping_step(state, {{}, &scan, nullptr});
  }
  EXPECT_EQ(state.losses().queue_full, 24U);
}

struct Drive {
  std::vector<types::Odometry> odometry;
  std::vector<types::Scan> scans;
};

Drive drive() {
  Drive out;
  for (int ms = 0; ms <= 2800; ms += 100) {
    out.odometry.push_back(odometry_at(ms, truth_at(0).inverse() * truth_at(ms)));
    if (ms % 200 == 0) out.scans.push_back(scan_at(ms, truth_at(ms)));
  }
  return out;
}

/// How the same input is cut into steps must not matter.
TEST(MappingStep, AnySplitOfTheInputGivesTheSamePoses) {
  const Drive input = drive();
  MappingState together{slam::MapperParams{}}, apart{slam::MapperParams{}};
  (void)mapping_step(together, {input.odometry, nullptr, nullptr});
  for (const types::Scan& scan : input.scans) (void)mapping_step(together, {{}, &scan, nullptr});
  std::size_t next = 0;
  for (const types::Odometry& sample : input.odometry) {
    (void)mapping_step(apart, {{&sample, 1}, nullptr, nullptr});
    while (next < input.scans.size() && input.scans[next].first_beam <= sample.stamp) {
      (void)mapping_step(apart, {{}, &input.scans[next++], nullptr});
    }
  }
  (void)together.finish();
  (void)apart.finish();
  ASSERT_GT(together.mapper().poses().size(), 3U);
  const auto a = together.mapper().poses(), b = apart.mapper().poses();
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
}

/// A robot that goes ahead for a while and then stands, whose third keyframe is told to be off.
class ToldOff {
 public:
  explicit ToldOff(int goes_ms, const Se2& off = {0.3, 0.2, 0.0}) : goes_ms_(goes_ms), off_(off) {}

  /// One scan.
  MappingOutput step() {
    const Se2 truth = truth_at(std::min(ms_, goes_ms_));
    const types::Odometry odometry = odometry_at(ms_, truth_at(0).inverse() * truth);
    const types::Scan scan = scan_at(ms_, truth);
    ms_ += 100;
    MappingOutput output = mapping_step(state_, {{&odometry, 1}, &scan, nullptr});
    if (!told_ && state_.mapper().keyframes().size() == 3) tell();
    return output;
  }
  MappingState& state() { return state_; }

  /// Cells that are not as when all keyframes had been drawn at the mapper's poses.
  [[nodiscard]] std::size_t cells_elsewhere() {
    slam::MapBuilder direct({});
    direct.update(state_.mapper().keyframes(), state_.mapper().poses());
    return grid::differing_cells(state_.make_snapshot()->grid, direct.grid());
  }

 private:
  void tell() {
    told_ = true;
    slam::LoopCandidate candidate;
    candidate.rejection = slam::LoopRejection::kNone;
    const auto poses = state_.mapper().poses();
    const Eigen::Matrix3d sure = Eigen::Vector3d(1e4, 1e4, 1e5).asDiagonal();
    candidate.edge = {0, 2, poses[0].inverse() * poses[2] * off_, sure, false};
    state_.offer(slam::LoopAnswer{2, {candidate}});
  }

  int goes_ms_;
  Se2 off_;
  int ms_ = 0;
  bool told_ = false;
  MappingState state_{slam::MapperParams{}};
};

TEST(MappingStep, PosesAndMapAreCorrectedTogetherWhenBothAreReady) {
  for (const int goes_ms : {100000, 2800}) {
    SCOPED_TRACE(goes_ms);
    ToldOff robot(goes_ms);
    std::optional<slam::GraphQuery> query;
    for (int i = 0; i < 40 && !query; ++i) query = robot.step().graph_query;
    ASSERT_TRUE(query) << "told to be off";
    const Se2 first_opinion = robot.state().mapper().poses()[2];
    robot.state().offer(slam::solve_graph(*query));
    bool corrected = false;
    for (int i = 0; i < 20 && !corrected; ++i) {
      EXPECT_EQ(robot.state().mapper().poses()[2], first_opinion);
      EXPECT_EQ(robot.cells_elsewhere(), 0U);
      corrected = robot.step().corrected;
    }
    ASSERT_TRUE(corrected) << "at the next keyframe, or a second later";
    EXPECT_GT((robot.state().mapper().poses()[2].translation() - first_opinion.translation()).norm(), 0.05);
    EXPECT_LT(robot.cells_elsewhere(), 100U) << "keyframes that hardly moved are not drawn again";
    EXPECT_FALSE(robot.step().graph_query) << "nothing new since";
  }
}

TEST(MappingStep, WhatACorrectionLeftALittleOffIsDrawnAndShownByAndBy) {
  ToldOff robot(2800, {0.015, 0.012, 0.0});
  std::optional<slam::GraphQuery> query;
  for (int i = 0; i < 40 && !query; ++i) query = robot.step().graph_query;
  ASSERT_TRUE(query);
  robot.state().offer(slam::solve_graph(*query));
  for (int i = 0; i < 40 && !robot.step().corrected; ++i) {
  }
  ASSERT_GT(robot.cells_elsewhere(), 0U) << "nothing to draw";
  int shown = 0;
  for (int i = 0; i < 100; ++i) shown += robot.step().keyframe_added ? 1 : 0;
  EXPECT_EQ(robot.cells_elsewhere(), 0U);
  EXPECT_EQ(shown, 1) << "who stands makes no keyframes, and tells of the map once";
}

TEST(MappingStep, AGraphThatWasNotSolvedIsAskedAboutAgain) {
  ToldOff robot(100000);
  std::optional<slam::GraphQuery> query, again;
  for (int i = 0; i < 40 && !query; ++i) query = robot.step().graph_query;
  ASSERT_TRUE(query);
  for (int i = 0; i < 20; ++i) ASSERT_FALSE(robot.step().graph_query) << "one at a time";
  robot.state().offer(slam::GraphSolution{});
  for (int i = 0; i < 20 && !again; ++i) again = robot.step().graph_query;
  EXPECT_TRUE(again);
  (void)robot.state().finish();
  const Se2 solved = robot.state().mapper().poses()[2];
  robot.state().offer(slam::solve_graph(*query));
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(robot.step().corrected) << "too late";
  EXPECT_EQ(robot.state().mapper().poses()[2], solved);
}

TEST(MapSnapshot, NeverChangesAndCarriesPoseWithMap) {
  const Drive input = drive();
  MappingState state{slam::MapperParams{}};
  (void)mapping_step(state, {input.odometry, &input.scans[0], nullptr});
  const auto early = state.make_snapshot();
  std::size_t known = 0;
  early->grid.for_each_known([&](grid::CellIndex, grid::CellState) { ++known; });
  for (std::size_t i = 1; i < input.scans.size(); ++i)
    (void)mapping_step(state, {{}, &input.scans[i], nullptr});
  std::size_t still = 0, now = 0;
  early->grid.for_each_known([&](grid::CellIndex, grid::CellState) { ++still; });
  const auto late = state.make_snapshot();
  late->grid.for_each_known([&](grid::CellIndex, grid::CellState) { ++now; });
  EXPECT_GT(known, 1000U);
  EXPECT_EQ(still, known);
  EXPECT_NE(now, known);
  EXPECT_EQ(late->changed_cells - early->changed_cells, grid::differing_cells(early->grid, late->grid));
  EXPECT_GT(late->changed_cells, early->changed_cells);
  EXPECT_EQ(state.make_snapshot()->changed_cells, late->changed_cells) << "nothing new";
  EXPECT_GT(late->revision, early->revision);
  EXPECT_GT(late->keyframes.size(), early->keyframes.size());
  EXPECT_NEAR(late->T_map_base.x_m(), 1.4, 0.03) << "0.5 m/s for 2.8 s";
  EXPECT_EQ(late->stamp, Stamp{milliseconds(2800)});
}

/// A robot that goes ahead, turns where it sees nothing, and stands; a hundredth of a radian of doubt is
/// enough for a search of its past.
class LostAndIdle {
 public:
  LostAndIdle() : state_(params()) {
    for (int ms = 0; ms <= 8000; ms += 100) (void)step(ms, {0.0005 * ms, 0.0, 0.0}, true);
    for (int ms = 8100; ms <= 12'000; ms += 100) (void)step(ms, {4.0, 0.0, 0.001 * (ms - 8000)}, false);
  }
  static slam::MapperParams params() {
    slam::MapperParams params;
    params.past = {.window = 6, .every = 3, .past_min = 3};
    params.loop.search_max_rad = 0.01;
    params.loop.chain_gap_m = 1.0;
    return params;
  }
  MappingOutput step(int ms, const Se2& pose, bool sees, bool is_searching = false) {
    const types::Odometry odometry = odometry_at(ms, pose);
    types::Scan scan = scan_at(ms, truth_at(0) * pose);
    if (!sees) scan.range_m.fill(types::kInvalid);
    return mapping_step(state_, {{&odometry, 1}, &scan, nullptr, is_searching});
  }
  /// Searches of its past while it stands for half a minute.
  int looks_back(bool is_searching) {
    int looks = 0;
    for (int i = 0; i < 300; ++i, ms_ += 100)
      looks += step(ms_, {4.0, 0.0, 4.0}, false, is_searching).alignment_query ? 1 : 0;
    return looks;
  }

 private:
  MappingState state_;
  int ms_ = 12'100;
};

TEST(MappingStep, AStandingRobotHasItsPastSearched) { EXPECT_GE(LostAndIdle().looks_back(false), 1); }

TEST(MappingStep, WhileSearchesAreLeftThatOfThePastWaitsAndIsNotLost) {
  LostAndIdle robot;
  EXPECT_EQ(robot.looks_back(true), 0);
  const int later = robot.looks_back(false);
  EXPECT_GE(later, 1);
  EXPECT_EQ(later, LostAndIdle().looks_back(false));
}

}  // namespace
}  // namespace topo::pipeline

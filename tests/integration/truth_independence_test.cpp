// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// The robot decides by what comes over its wires and by nothing else: the readings of one exploration are
// given once more to a fresh robot while the simulator's truth is another one, and every plan, every reason
// and every command is the same to the byte.

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/bench/topobench/explore/explore_run.hpp"

namespace topo::bench {
namespace {

/// Values one after the other, without the padding that a struct has between them.
class Bytes {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    const auto at = text_.size();
    text_.resize(at + sizeof value);
    std::memcpy(text_.data() + at, &value, sizeof value);
  }
  void add(const types::Se2& pose) { add(pose.x_m), add(pose.y_m), add(pose.theta_rad); }
  void add(const std::string& text) { text_ += text; }
  void add(types::Stamp stamp) { add(stamp.time_since_epoch().count()); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string bytes_of(const pipeline::PlanningOutput& output) {
  Bytes bytes;
  const pipeline::Plan& plan = output.plan;
  bytes.add(plan.stamp), bytes.add(plan.sequence), bytes.add(plan.goal_id), bytes.add(plan.activity);
  bytes.add(plan.moving), bytes.add(plan.path_ends_at_goal), bytes.add(plan.T_map_odom.se2());
  bytes.add(plan.located);
  for (std::size_t i = 0; i < plan.points; ++i)
    bytes.add(plan.path_odom[i].x()), bytes.add(plan.path_odom[i].y());
  const pipeline::PlanningReport& report = *output.report;
  bytes.add(report.reason), bytes.add(report.known_m2), bytes.add(report.goals_issued);
  for (const pipeline::Decision& decision : report.decisions)
    bytes.add(decision.stamp), bytes.add(decision.text);
  return bytes.text();
}

std::string bytes_of(const pipeline::ControlOutput& output) {
  Bytes bytes;
  bytes.add(output.command.twist.v_mps), bytes.add(output.command.twist.omega_radps);
  bytes.add(output.command.enable_motors), bytes.add(output.command.estop);
  bytes.add(output.report.mode), bytes.add(output.report.reason), bytes.add(output.report.free_distance_m);
  return bytes.text();
}

/// Everything that the robot decided, in order, and how far it wanted to drive.
class Trace : public RunHooks {
 public:
  void planned(const pipeline::PlanningOutput& output) override { decisions.push_back(bytes_of(output)); }
  void commanded(const pipeline::ControlOutput& output) override {
    decisions.push_back(bytes_of(output));
    driven_m += 0.05 * output.command.twist.v_mps;
  }
  std::vector<std::string> decisions;
  double driven_m = 0.0;
};

class Recorder final : public Trace {
 public:
  void readings(Readings& readings) override { recorded.push_back(readings); }
  std::vector<Readings> recorded;
};

/// Hands out what was recorded, and carries the robot about and puts things in its way meanwhile.
class OtherTruth final : public Trace {
 public:
  explicit OtherTruth(const std::vector<Readings>& recorded) : recorded_(recorded) {}

  void readings(Readings& readings) override {
    if (next_ < recorded_.size()) readings = recorded_[next_++];
  }
  void ticked(Plant& plant) override {
    if (plant.now() % std::chrono::seconds(1) != sim::SimTime{0}) return;
    const auto starts = plant.world().start_poses();
    plant.body().teleport(starts[++carried % starts.size()]);
  }
  std::size_t carried = 0;

 private:
  const std::vector<Readings>& recorded_;
  std::size_t next_ = 0;
};

struct Case {
  Fidelity fidelity;
  exploration::Strategy strategy;
  double seconds;
};

class SameReadings : public ::testing::TestWithParam<Case> {};

TEST_P(SameReadings, GiveTheSameDecisionsWhateverTheTruthIs) {
  const auto load = [](const char* name) {
    auto world = sim::World::load(std::filesystem::path(TOPOMETRIC_SOURCE_DIR) / "config/worlds" / name);
    EXPECT_TRUE(world.has_value()) << world.error().message;
    return std::move(*world);
  };
  sim::World course = load("course.toml"), office = load("office.toml");
  RunSetup setup = default_setup(course.start_poses().front(), 1, GetParam().fidelity);
  setup.limit_s = GetParam().seconds;
  setup.mind.planner.explore.strategy = GetParam().strategy;
  const auto& structure = course.structure();
  const sim::Raster nothing(structure.resolution_m, structure.origin, structure.width, structure.height);

  Recorder first;
  auto plant = make_plant(std::move(course), setup);
  ASSERT_TRUE(plant.has_value()) << plant.error().message;
  auto mind = make_mind(setup);
  const RunResult told = run_exploration(**plant, *mind, setup, nothing, &first);

  RunSetup elsewhere = setup;
  elsewhere.plant.start = office.start_poses().back();
  elsewhere.plant.seed = 77;
  auto other_plant = make_plant(std::move(office), elsewhere);
  ASSERT_TRUE(other_plant.has_value()) << other_plant.error().message;
  OtherTruth second(first.recorded);
  auto other_mind = make_mind(elsewhere);
  const RunResult retold = run_exploration(**other_plant, *other_mind, elsewhere, nothing, &second);

  EXPECT_GT(first.driven_m, 5.0) << "a robot that stands decides nothing";
  EXPECT_GT(second.carried, 10U);
  EXPECT_NE(told.truth.back(), retold.truth.back());
  ASSERT_EQ(first.decisions.size(), second.decisions.size());
  for (std::size_t i = 0; i < first.decisions.size(); ++i)
    ASSERT_EQ(first.decisions[i], second.decisions[i])
        << "decision " << i << " of " << first.decisions.size();
}

INSTANTIATE_TEST_SUITE_P(Runs, SameReadings,
                         ::testing::Values(Case{Fidelity::kFull, exploration::Strategy::kTopometric, 45.0},
                                           Case{Fidelity::kPlan, exploration::Strategy::kTopometric, 60.0},
                                           Case{Fidelity::kPlan, exploration::Strategy::kNearestFrontier,
                                                60.0}));

}  // namespace
}  // namespace topo::bench

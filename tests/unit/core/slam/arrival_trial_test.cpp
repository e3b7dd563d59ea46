// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/arrival_trial.hpp"

#include <gtest/gtest.h>

#include "core/slam/placement.hpp"
#include "tests/unit/core/slam/twin_session.hpp"

namespace topo::slam {
namespace {

using types::Se2;

TEST(TrialFinding, ByOverlapFitAndContradiction) {
  struct Row {
    TrialEvidence evidence;
    TrialFinding finding;
  };
  const std::vector<Row> rows{
      {{true, 0.9, 0.9, 0.0, false}, TrialFinding::kMatches},
      {{true, 0.3, 0.65, 0.15, false}, TrialFinding::kMatches},
      {{true, 0.9, 0.9, 0.0, true}, TrialFinding::kSaysNothing},
      {{true, 0.29, 0.9, 0.0, false}, TrialFinding::kSaysNothing},
      {{true, 0.9, 0.64, 0.0, false}, TrialFinding::kContradicts},
      {{true, 0.9, 0.64, 0.0, true}, TrialFinding::kContradicts},
      {{true, 0.9, 0.9, 0.16, false}, TrialFinding::kContradicts},
      {{true, 0.1, 0.9, 0.16, false}, TrialFinding::kContradicts},
      {{false, 0.9, 0.9, 0.0, false}, TrialFinding::kContradicts},
  };
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_EQ(finding_of(rows[i].evidence, {}), rows[i].finding) << "row " << i;
}

/// The trial after `count` scans of one kind in a row, a step each.
TrialCount after(TrialCount before, TrialFinding finding, int count, double step_m = 0.1) {
  for (int i = 0; i < count; ++i) before = counted(before, finding, step_m, {});
  return before;
}

TEST(TrialCount, PassesAfterEightMetresThatMatch) {
  const TrialCount early = after({}, TrialFinding::kMatches, 79);
  EXPECT_EQ(early.verdict, TrialVerdict::kRunning);
  EXPECT_EQ(after(early, TrialFinding::kMatches, 2).verdict, TrialVerdict::kPassed);
}

TEST(TrialCount, ATurnOnTheSpotDoesNotPass) {
  EXPECT_EQ(after({}, TrialFinding::kMatches, 500, 0.0).verdict, TrialVerdict::kRunning);
}

TEST(TrialCount, DropsWhenSixOfTenContradict) {
  const TrialCount good = after({}, TrialFinding::kMatches, 20);
  EXPECT_EQ(after(good, TrialFinding::kContradicts, 5).verdict, TrialVerdict::kRunning);
  EXPECT_EQ(after(good, TrialFinding::kContradicts, 6).verdict, TrialVerdict::kDropped);
  // Ground that is new in between changes nothing, and neither do fewer than ten scans.
  const TrialCount between = after(after(good, TrialFinding::kContradicts, 3), TrialFinding::kSaysNothing, 9);
  EXPECT_EQ(after(between, TrialFinding::kContradicts, 3).verdict, TrialVerdict::kDropped);
  EXPECT_EQ(after({}, TrialFinding::kContradicts, 9).verdict, TrialVerdict::kRunning);
  EXPECT_EQ(after({}, TrialFinding::kContradicts, 10).verdict, TrialVerdict::kDropped);
}

TEST(TrialCount, AVerdictStays) {
  const TrialCount passed = after({}, TrialFinding::kMatches, 90);
  EXPECT_EQ(after(passed, TrialFinding::kContradicts, 20).verdict, TrialVerdict::kPassed);
  const TrialCount dropped = after({}, TrialFinding::kContradicts, 10);
  EXPECT_EQ(after(dropped, TrialFinding::kMatches, 90).verdict, TrialVerdict::kDropped);
}

TEST(TrialCount, NewGroundTakesFifteenMetres) {
  const TrialCount some = after({}, TrialFinding::kMatches, 10);
  EXPECT_EQ(after(some, TrialFinding::kSaysNothing, 130).verdict, TrialVerdict::kRunning);
  EXPECT_EQ(after(some, TrialFinding::kSaysNothing, 142).verdict, TrialVerdict::kPassed);
  // Every other scan contradicts: never six of ten, and not a match.
  TrialCount half = after({}, TrialFinding::kMatches, 0);
  for (int i = 0; i < 76; ++i)
    half = after(after(half, TrialFinding::kMatches, 1), TrialFinding::kContradicts, 1);
  EXPECT_EQ(half.verdict, TrialVerdict::kDropped);
}

/// A robot that is believed in one place and drives in another: its scans are tracked as in the product.
class TrialDrive {
 public:
  TrialDrive(testing::TwinSession& twins, const Se2& truth, const Se2& believed)
      : twins_(twins), mapper_({}, Origin{1, 7}), from_(truth), at_(truth) {
    const Placement placed =
        place_in(twins.session, twins.view(truth).cloud, {twins.in_map(believed), false, false}, {});
    EXPECT_TRUE(placed.is_fact()) << describe(placed);
    Arrival arrival{
        twins.view(truth).cloud, {}, placed.place.match.T_map_base, placed.place.match.scan_information};
    for (const Match& other : placed.others) arrival.rivals.push_back(other.T_map_base);
    mapper_.resume(twins.session, arrival);
    trial_.emplace(twins.session, arrival, MapperParams{});
  }
  /// Straight to a place, turned there first; the way driven until the verdict, at most to the place.
  void to(double x_m, double y_m) {
    const types::Vector2 aim{x_m, y_m};
    const Se2 begin = at_;
    const types::Vector2 way = aim - begin.translation();
    const double heading = std::atan2(way.y(), way.x());
    const double turn = types::wrap_angle(heading - begin.theta_rad);
    for (int i = 1; i <= 20; ++i) see({begin.x_m, begin.y_m, begin.theta_rad + turn * i / 20});
    const int steps = static_cast<int>(way.norm() / 0.05);
    for (int i = 1; i <= steps; ++i) {
      const types::Vector2 p = begin.translation() + way * (static_cast<double>(i) / steps);
      see({p.x(), p.y(), heading});
    }
  }
  [[nodiscard]] const TrialCount& count() const { return trial_->count(); }

 private:
  void see(const Se2& truth) {
    at_ = truth;
    const testing::View view = twins_.view(truth);
    Cloud cloud = view.cloud;
    stamp_ += std::chrono::milliseconds(100);
    cloud.stamp = stamp_;
    const MatchReport report = mapper_.add(cloud, from_.inverse() * truth, columns_);
    trial_->add(cloud, report.T_map_base, report.T_odom_base, report.matched);
  }
  testing::TwinSession& twins_;
  Mapper mapper_;
  Se2 from_, at_;
  types::Stamp stamp_{};
  walls::ColumnCollector columns_{{}};
  std::optional<ArrivalTrial> trial_;
};

constexpr Se2 kFirst{2.5, 7.5, -0.6}, kSecond{10.5, 7.5, -0.6};

TEST(ArrivalTrial, TheRightOfTwoTwinsPasses) {
  testing::TwinSession twins;
  TrialDrive drive(twins, kSecond, kSecond);
  drive.to(11.5, 6.5);
  EXPECT_EQ(drive.count().matched, 0) << "the other room explains it as well";
  drive.to(11.5, 1.4);
  drive.to(4.0, 1.4);
  EXPECT_EQ(drive.count().verdict, TrialVerdict::kPassed);
  EXPECT_EQ(drive.count().contradicted, 0);
}

TEST(ArrivalTrial, TheWrongOfTwoTwinsIsDroppedAtTheDoor) {
  for (const auto& [truth, believed] : {std::pair(kFirst, kSecond), std::pair(kSecond, kFirst)}) {
    testing::TwinSession twins;
    TrialDrive drive(twins, truth, believed);
    const double door_x_m = truth.x_m + 1.0;
    drive.to(door_x_m, 6.5);
    EXPECT_EQ(drive.count().verdict, TrialVerdict::kRunning);
    drive.to(door_x_m, 1.4);
    drive.to(8.0, 1.4);
    EXPECT_EQ(drive.count().verdict, TrialVerdict::kDropped);
    EXPECT_LT(drive.count().way_m, 10.0);
  }
}

/// The map holds one room only, so that nothing in it is a rival of the other.
TEST(ArrivalTrial, ATwinOutsideTheMapIsDroppedToo) {
  testing::TwinSession twins;
  Session small = twins.session;
  small.edges.clear();
  std::size_t room = 0;  // until the path leaves the first room
  while (twins.session.poses[room].x_m < 4.0) ++room;
  small.keyframes.resize(room);
  small.poses.resize(room);
  twins.session = small;
  TrialDrive drive(twins, kSecond, kFirst);
  drive.to(11.5, 6.5);
  drive.to(11.5, 1.4);
  drive.to(4.0, 1.4);
  EXPECT_EQ(drive.count().verdict, TrialVerdict::kDropped);
}

TEST(ArrivalTrial, AStandingRobotLearnsNothing) {
  testing::TwinSession twins;
  const Cloud cloud = twins.view(kFirst).cloud;
  const Se2 place = twins.in_map(kFirst);
  ArrivalTrial trial(twins.session, {cloud, {}, place}, {});
  for (int i = 0; i < 100; ++i) trial.add(cloud, place, {}, true);
  EXPECT_EQ(trial.count().matched, 1);
  EXPECT_EQ(trial.count().verdict, TrialVerdict::kRunning);
  // An odometry that was reset is no way.
  trial.add(cloud, place, {30.0, 0.0, 0.0}, true);
  EXPECT_EQ(trial.count().matched, 2);
  EXPECT_EQ(trial.count().way_m, 0.0);
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/relations.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "tests/unit/bench/carmen/sample_log.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::bench {
namespace {

using ::testing::HasSubstr;
using types::Se2;

TEST(Relations, ReadsPlainAndPackedLines) {
  const daemon::testing::TempDir dir;
  const std::string text = "# made by hand\n1.5 2.5 0.5 -0.25 9 8 7 0.125\n\n2.5 3 1 2 0 0 0 -3\n";
  for (const std::string& content : {text, testing::bzip2(text)}) {
    const auto relations = read_relations(dir.write("r", content));
    ASSERT_TRUE(relations.has_value()) << relations.error().message;
    ASSERT_EQ(relations->size(), 2U);
    EXPECT_DOUBLE_EQ((*relations)[0].t1_s, 1.5);
    EXPECT_DOUBLE_EQ((*relations)[0].t2_s, 2.5);
    EXPECT_EQ((*relations)[0].relative, (Se2{0.5, -0.25, 0.125}));
    EXPECT_EQ((*relations)[1].relative, (Se2{1.0, 2.0, -3.0}));
  }
}

TEST(Relations, SaysWhereAndWhatIsWrong) {
  const daemon::testing::TempDir dir;
  struct Case {
    std::string text, message;
  };
  for (const Case& c : {Case{"", "found no relation"}, Case{"1 2 3\n", "rel:1: found 3 words, expected 8"},
                        Case{"1 2 0 0 0 0 0 nan\n", "\"nan\" in word 8 (rotation)"},
                        Case{"1 x 0 0 0 0 0 0\n", "\"x\" in word 2 (t2)"}}) {
    const auto relations = read_relations(dir.write("rel", c.text));
    ASSERT_FALSE(relations.has_value());
    EXPECT_THAT(relations.error().message, HasSubstr(c.message));
  }
}

TEST(Relations, TakesTheNearestPoseWithinTheTolerance) {
  const std::vector<TimedPose> path{
      {1.0, {0, 0, std::numbers::pi / 2}}, {2.0, {0, 3, std::numbers::pi / 2}}, {3.0, {9, 9, 0}}};
  const std::vector<Relation> relations{
      {1.05, 1.95, {3.3, 0.4, 0.1}}, {1.0, 2.2, {0, 0, 0}}, {5.0, 1.0, {0, 0, 0}}};
  const RelationErrors e = evaluate_relations(relations, path);
  EXPECT_EQ(e.used, 1);
  EXPECT_EQ(e.skipped, 2);
  EXPECT_NEAR(e.trans_mean_m, 0.5, 1e-12);
  EXPECT_NEAR(e.trans_std_m, 0.0, 1e-12);
  EXPECT_NEAR(e.rot_mean_rad, 0.1, 1e-12);
}

TEST(Relations, WrapsTheRotationAndUsesThePopulationsDeviation) {
  const std::vector<TimedPose> path{{0, {0, 0, 3.0}}, {1, {0, 0, -3.0}}};
  const std::vector<Relation> relations{{0, 1, {0, 0, 0.0}}, {0, 1, {2.0, 0, 2 * std::numbers::pi - 6.0}}};
  const RelationErrors e = evaluate_relations(relations, path);
  EXPECT_EQ(e.used, 2);
  EXPECT_NEAR(e.trans_mean_m, 1.0, 1e-12);
  EXPECT_NEAR(e.trans_std_m, 1.0, 1e-12);
  EXPECT_NEAR(e.rot_max_rad, 2 * std::numbers::pi - 6.0, 1e-12);
  EXPECT_NEAR(e.rot_mean_rad, std::numbers::pi - 3.0, 1e-12);
}

TEST(Relations, AnEmptyTrajectorySkipsAll) {
  const std::vector<Relation> relations{{0, 1, {}}};
  EXPECT_EQ(evaluate_relations(relations, {}).skipped, 1);
}

TEST(Relations, ATrajectoryHasNoErrorAgainstItselfWhateverTheFrame) {
  EXPECT_TRUE(
      rc::check([](const std::vector<std::array<std::int16_t, 3>>& poses, std::int16_t x, std::int16_t turn) {
        RC_PRE(poses.size() >= 2U);
        const Se2 frame{x / 100.0, 1.0, turn / 5000.0};
        std::vector<TimedPose> path, moved;
        std::vector<Relation> relations;
        for (std::size_t i = 0; i < poses.size(); ++i) {
          const Se2 pose{poses[i][0] / 100.0, poses[i][1] / 100.0, poses[i][2] / 5000.0};
          path.push_back({static_cast<double>(i), pose});
          moved.push_back({static_cast<double>(i), frame * pose});
          if (i > 0)
            relations.push_back(
                {static_cast<double>(i) - 1.0, static_cast<double>(i), path[i - 1].pose.inverse() * pose});
        }
        const RelationErrors e = evaluate_relations(relations, moved);
        RC_ASSERT(e.skipped == 0);
        RC_ASSERT(e.trans_max_m < 1e-6);
        RC_ASSERT(e.rot_max_rad < 1e-6);
      }));
}

}  // namespace
}  // namespace topo::bench

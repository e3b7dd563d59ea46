// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/team_node.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <random>
#include <utility>

namespace topo::bench {
namespace {

/// Notes what a node gives to its mapper; makes keyframes when told.
class FakeSource final : public SharedMapSource {
 public:
  void take(const Readings& /*readings*/) override {}
  [[nodiscard]] const pipeline::MapSnapshot& map() const override { return *snapshot_; }
  [[nodiscard]] const pipeline::TrackedPose& tracked() const override { return tracked_; }
  void join(const TeamNews& news) override {
    for (const PosedKeyframe& keyframe : news.keyframes) {
      joined.push_back(keyframe.keyframe->id);
      poses_[keyframe.keyframe->id] = keyframe.T_map_base;
    }
    for (const slam::FoundRelation& found : news.relations) related.push_back(found.id);
  }
  TeamNews take_new() override { return std::exchange(new_, {}); }
  [[nodiscard]] const types::Se2& T_map_base() const override { return stands; }
  [[nodiscard]] const types::Se2* find_pose(const slam::KeyframeId& id) const override {
    const auto at = poses_.find(id);
    return at == poses_.end() ? nullptr : &at->second;
  }
  [[nodiscard]] std::optional<types::Se2> T_map_mates(std::uint16_t /*robot*/) const override {
    return T_map_mate;
  }

  /// A keyframe, and the relation that ties it to the one before.
  void make(std::uint16_t robot, std::uint32_t sequence) {
    auto keyframe = std::make_shared<slam::Keyframe>();
    keyframe->id = {robot, sequence};
    poses_[keyframe->id] = {1.0 * sequence, 1.0 * robot, 0.0};
    new_.keyframes.push_back({keyframe, poses_[keyframe->id]});
    if (sequence > 0)
      new_.relations.push_back(
          {{robot, sequence - 1}, {{robot, sequence - 1}, {robot, sequence}}, {{0.4, 0.0, 0.0}}});
  }
  std::vector<slam::KeyframeId> joined, related;
  types::Se2 stands;
  std::optional<types::Se2> T_map_mate = types::Se2{};

 private:
  TeamNews new_;
  std::map<slam::KeyframeId, types::Se2> poses_;
  std::unique_ptr<pipeline::MapSnapshot> snapshot_;
  pipeline::TrackedPose tracked_;
};

const std::vector<types::Se2> kStarts{{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {4.0, 0.0, 0.0}};

struct Robot {
  explicit Robot(std::uint16_t id) : node(id, source, slam::MapperParams{}, kStarts) {}
  FakeSource source;
  TeamNode node;
};

team::StatusMessage message(std::uint16_t robot, double x_m) {
  team::StatusMessage w;
  w.robot = robot;
  w.sequence = 1;
  w.T_map_base = {x_m, 0.0, 0.0};
  return w;
}

bool each_once(std::vector<slam::KeyframeId> ids, std::size_t count) {
  std::sort(ids.begin(), ids.end());
  return ids.size() == count && std::adjacent_find(ids.begin(), ids.end()) == ids.end();
}

TEST(TeamNode, allGetEverythingOnceDespiteLossAndRepetition) {
  EXPECT_TRUE(rc::check("a link that works now and then is enough", [] {
    std::deque<Robot> robots;
    for (std::uint16_t id = 0; id < 3; ++id) robots.emplace_back(id);
    const double loss = *rc::gen::inRange(0, 9) / 10.0;
    std::mt19937 random(*rc::gen::arbitrary<unsigned>());
    const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
    std::deque<std::tuple<std::uint16_t, std::uint16_t, Letter>> late;
    for (std::uint32_t round = 0; round < 400; ++round) {
      for (std::uint16_t id = 0; id < 3; ++id) {
        if (round < 40) robots[id].source.make(id, round);
        robots[id].node.gather();
      }
      for (std::uint16_t from = 0; from < 3; ++from) {
        for (std::uint16_t to = 0; to < 3; ++to) {
          // The first and the third never hear each other: the second hands on.
          if (from == to || from + to == 2 || draw() < loss) continue;
          late.emplace_back(from, to, robots[from].node.letter_to(to));
        }
      }
      while (!late.empty() && (late.size() > 5 || round == 399)) {
        const auto [from, to, letter] = late.front();
        late.pop_front();
        robots[to].node.take(from, letter, {});
        if (draw() < 0.2) robots[to].node.take(from, letter, {});
      }
    }
    for (const Robot& robot : robots) {
      RC_ASSERT(robot.node.keyframes().size() == 120U);
      RC_ASSERT(robot.node.keyframes() == robots[0].node.keyframes());
      RC_ASSERT(robot.node.relations().size() == 117U);
      RC_ASSERT(robot.node.relations().counts() == robots[0].node.relations().counts());
      RC_ASSERT(each_once(robot.source.joined, 80U));
      RC_ASSERT(each_once(robot.source.related, 78U));
    }
    RC_ASSERT(robots[2].source.find_pose({0, 7})->x_m == 7.0);
  }));
}

TEST(TeamNode, aWordSaysWhereTheRobotIsWhenItIsSent) {
  Robot robot(0), mate(1);
  mate.node.say(message(1, 5.0));
  for (const double x_m : {5.1, 5.2}) {
    mate.source.stands.x_m = x_m;
    mate.node.gather();
    robot.node.take(1, mate.node.letter_to(0), {});
  }
  const auto messages = robot.node.heard().messages;
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[1].T_map_base.x_m, 5.2);
  EXPECT_GT(messages[1].sequence, messages[0].sequence);
}

TEST(TeamNode, hearsAMateInItsOwnFrameOrNotAtAll) {
  Robot robot(0), mate(1);
  team::StatusMessage said = message(1, 5.0);
  said.claim = team::Bid{{6.0, 0.0}, 3.0};
  said.looked = {{7.0, 0.0}};
  mate.node.say(said);
  mate.source.stands = {5.0, 0.0, 0.0};
  mate.node.gather();
  robot.source.T_map_mate.reset();
  robot.node.take(1, mate.node.letter_to(0), {});
  EXPECT_TRUE(robot.node.heard().messages.empty()) << "where the mate's map lies is not known";
  robot.source.T_map_mate = types::Se2{1.0, 2.0, 0.5 * std::numbers::pi};
  robot.node.take(1, mate.node.letter_to(0), {});
  const auto messages = robot.node.heard().messages;
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_LT((messages[0].T_map_base.translation() - types::Vector2(1.0, 7.0)).norm(), 1e-12);
  EXPECT_LT((messages[0].claim->p_map - types::Vector2(1.0, 8.0)).norm(), 1e-12);
  EXPECT_EQ(messages[0].claim->cost_m, 3.0);
  EXPECT_LT((messages[0].looked.front() - types::Vector2(1.0, 9.0)).norm(), 1e-12);
}

TEST(TeamNode, handsEachWordToThePlannerOnce) {
  Robot robot(0), mate(1);
  mate.node.say(message(1, 5.0));
  robot.node.take(1, mate.node.letter_to(0), {});
  EXPECT_EQ(robot.node.heard().messages.size(), 1U);
  EXPECT_TRUE(robot.node.heard().messages.empty());
  EXPECT_EQ(robot.node.heard().robot, 0U);
}

/// Readings of one scan, all beams 2 m, at a time, from the map's origin.
Readings readings_at(double t_s) {
  Readings readings;
  types::Scan& scan = readings.front.emplace_back();
  scan.beams = 181;
  scan.geometry.angle_min_rad = -1.570796F;
  scan.geometry.angle_increment_rad = 0.0174533F;
  for (std::size_t i = 0; i < scan.beams; ++i) scan.range_m[i] = 2.0F;
  readings.coronal.push_back(scan);
  readings.poses.push_back({types::stamp_from_seconds(t_s), {}});
  return readings;
}

bool masks_ahead(Robot& robot, double t_s) {
  Readings readings = readings_at(t_s);
  robot.node.mask_mates(readings);
  return std::isnan(readings.front[0].range_m[90]);
}

TEST(TeamNode, masksMatesWhereTheySayTheyAreAndAtFirstAtTheirStarts) {
  Robot robot(0);
  EXPECT_TRUE(masks_ahead(robot, 1.0)) << "one is known to start there";
  EXPECT_FALSE(masks_ahead(robot, 31.0)) << "but it will have gone";
  Robot mate(1);
  mate.node.say(message(1, 50.0));
  robot.node.take(1, mate.node.letter_to(0), types::stamp_from_seconds(2.0));
  EXPECT_FALSE(masks_ahead(robot, 2.1)) << "it is elsewhere";
  mate.node.say(message(1, 2.2));
  robot.node.take(1, mate.node.letter_to(0), types::stamp_from_seconds(40.0));
  EXPECT_TRUE(masks_ahead(robot, 40.2));
  EXPECT_FALSE(masks_ahead(robot, 42.1)) << "that was long ago";
}

}  // namespace
}  // namespace topo::bench

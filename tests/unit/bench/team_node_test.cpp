// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/team_node.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
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
    for (const slam::KeyframePtr& keyframe : news.keyframes) {
      joined.push_back(keyframe->id);
      poses_[keyframe->id] = keyframe->T_odom_base;
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
    keyframe->T_odom_base = {1.0 * sequence, 1.0 * robot, 0.0};
    poses_[keyframe->id] = keyframe->T_odom_base;
    new_.keyframes.push_back(keyframe);
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

types::Stamp at(double t_s) { return types::stamp_from_seconds(t_s); }

/// All that one sends now arrives at the other at once.
void deliver(Robot& from, Robot& to, double t_s) {
  for (const team::Datagram& datagram : from.node.exchange(at(t_s))) to.node.take(datagram, at(t_s));
}

/// The same, and what the other says is not heard.
void send(Robot& from, Robot& to, double t_s) {
  deliver(from, to, t_s);
  (void)to.node.exchange(at(t_s));  // takes what came
}

TEST(TeamNode, allGetEverythingOnceDespiteLossAndRepetition) {
  EXPECT_TRUE(rc::check("a link that works now and then is enough", [] {
    std::deque<Robot> robots;
    for (std::uint16_t id = 0; id < 3; ++id) robots.emplace_back(id);
    const double loss = *rc::gen::inRange(0, 7) / 10.0;
    std::mt19937 random(*rc::gen::arbitrary<unsigned>());
    const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
    std::deque<std::pair<std::uint16_t, team::Datagram>> late;
    for (std::uint32_t round = 0; round < 1'200; ++round) {
      const double t_s = 0.1 * round;
      for (std::uint16_t from = 0; from < 3; ++from) {
        if (round < 40) robots[from].source.make(from, round);
        for (const team::Datagram& datagram : robots[from].node.exchange(at(t_s))) {
          for (std::uint16_t to = 0; to < 3; ++to) {
            // The first and the third never hear each other: the second hands on.
            if (from != to && from + to != 2 && draw() >= loss) late.emplace_back(to, datagram);
          }
        }
      }
      for (; late.size() > 5; late.pop_front()) {
        const auto& [to, datagram] = late.front();
        robots[to].node.take(datagram, at(t_s));
        if (draw() < 0.2) robots[to].node.take(datagram, at(t_s));
      }
    }
    for (const Robot& robot : robots) {
      RC_ASSERT(robot.node.state().items().hash() == robots[0].node.state().items().hash());
      RC_ASSERT(robot.node.own_keyframes().size() == 40U);
      RC_ASSERT(each_once(robot.source.joined, 80U));
      RC_ASSERT(each_once(robot.source.related, 78U));
    }
    RC_ASSERT(robots[2].source.find_pose({0, 7})->x_m == 7.0);
  }));
}

TEST(TeamNode, HasNoSetWantOrSendLogicOfItsOwn) {
  const char* top = std::getenv("TOPOMETRIC_SOURCE");
  ASSERT_NE(top, nullptr);
  std::set<std::string> includes;
  for (const char* name : {"team_node.hpp", "team_node.cpp"}) {
    std::ifstream file(std::filesystem::path(top) / "tests/bench/topobench/explore" / name);
    ASSERT_TRUE(file) << name;
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with("#include \"core/team/") || line.starts_with("#include \"core/slam/"))
        includes.insert(line);
    }
  }
  const std::set<std::string> allowed{
      "#include \"core/team/exchange/exchange.hpp\"", "#include \"core/team/masked_scan.hpp\"",
      "#include \"core/team/roster.hpp\"", "#include \"core/slam/params.hpp\""};
  EXPECT_EQ(includes, allowed);
}

TEST(TeamNode, aWordSaysWhereTheRobotIsWhenItIsSent) {
  Robot robot(0), mate(1);
  mate.node.say(message(1, 5.0));
  for (const double x_m : {5.1, 5.2}) {
    mate.source.stands.x_m = x_m;
    send(mate, robot, 10.0 * x_m);
    send(mate, robot, 10.0 * x_m + 0.5);
  }
  const auto messages = robot.node.heard().messages;
  ASSERT_GE(messages.size(), 2U);
  EXPECT_EQ(messages.front().T_map_base.x_m, 5.1);
  EXPECT_EQ(messages.back().T_map_base.x_m, 5.2);
  EXPECT_GT(messages.back().sequence, messages.front().sequence);
}

TEST(TeamNode, hearsAMateInItsOwnFrameOrNotAtAll) {
  Robot robot(0), mate(1);
  team::StatusMessage said = message(1, 5.0);
  said.claim = team::Bid{{6.0, 0.0}, 3.0};
  said.looked = {{7.0, 0.0}};
  mate.node.say(said);
  mate.source.stands = {5.0, 0.0, 0.0};
  robot.source.T_map_mate.reset();
  send(mate, robot, 0.0);
  EXPECT_TRUE(robot.node.heard().messages.empty()) << "where the mate's map lies is not known";
  robot.source.T_map_mate = types::Se2{1.0, 2.0, 0.5 * std::numbers::pi};
  for (double t_s = 0.5; t_s < 5.0; t_s += 0.1) {
    (void)robot.node.heard();
    deliver(mate, robot, t_s);
    deliver(robot, mate, t_s);
  }
  send(mate, robot, 6.0);
  const auto messages = robot.node.heard().messages;
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_LT((messages[0].T_map_base.translation() - types::Vector2(1.0, 7.0)).norm(), 1e-12);
  EXPECT_LT((messages[0].claim->p_map - types::Vector2(1.0, 8.0)).norm(), 1e-12);
  EXPECT_EQ(messages[0].claim->cost_m, 3.0);
  ASSERT_EQ(messages[0].looked.size(), 1U) << "by way of the log, which came before";
  EXPECT_LT((messages[0].looked.front() - types::Vector2(1.0, 9.0)).norm(), 1e-12);
}

TEST(TeamNode, handsEachWordToThePlannerOnce) {
  Robot robot(0), mate(1);
  mate.node.say(message(1, 5.0));
  send(mate, robot, 0.0);
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
  mate.source.stands.x_m = 50.0;
  send(mate, robot, 2.0);
  EXPECT_FALSE(masks_ahead(robot, 2.1)) << "it is elsewhere";
  mate.source.stands.x_m = 2.2;
  send(mate, robot, 40.0);
  EXPECT_TRUE(masks_ahead(robot, 40.2));
  EXPECT_FALSE(masks_ahead(robot, 42.1)) << "that was long ago";
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <deque>

#include "core/slam/canonical_map.hpp"
#include "core/team/exchange/exchange_state.hpp"
#include "tests/unit/core/slam/map_contents.hpp"
#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

// Whatever a radio does and however groups split and merge: in the end all hold the same, and have the same
// map.
namespace topo::team {
namespace {

using testing::at;
using testing::Robot;

constexpr std::size_t kRobots = 4;

/// A radio that loses, repeats and reorders, between robots of one group.
class Radio {
 public:
  Radio(double loss, unsigned seed) : loss_(loss), random_(seed) {}

  void regroup(const std::array<int, kRobots>& groups) { groups_ = groups; }
  void send(std::size_t from, const Datagram& datagram) {
    for (std::size_t to = 0; to < kRobots; ++to) {
      if (to == from || groups_.at(to) != groups_.at(from)) continue;
      for (int copies = draw() < loss_ ? 0 : draw() < 0.1 ? 2 : 1; copies > 0; --copies)
        under_way_.push_back({to, datagram});
    }
  }
  /// Delivers all but a few, and these in any order.
  void deliver(std::deque<Robot>& robots, types::Stamp now, std::size_t kept) {
    while (under_way_.size() > kept) {
      const auto reach = static_cast<double>(std::min<std::size_t>(under_way_.size(), 8));
      const auto at = under_way_.begin() + static_cast<std::ptrdiff_t>(draw() * reach);
      robots[at->first].exchange.take(at->second, now);
      under_way_.erase(at);
    }
  }

 private:
  double draw() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  double loss_;
  std::mt19937 random_;
  std::array<int, kRobots> groups_{};
  std::deque<std::pair<std::size_t, Datagram>> under_way_;
};

bool all_same(const std::deque<Robot>& robots) {
  return std::all_of(robots.begin(), robots.end(), [&](const Robot& robot) {
    return robot.exchange.items().hash() == robots[0].exchange.items().hash();
  });
}

void step(std::deque<Robot>& robots, Radio& radio, double t, std::size_t kept) {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (const Datagram& datagram : robots[i].exchange.datagrams(at(t))) radio.send(i, datagram);
  }
  radio.deliver(robots, at(t), kept);
}

TEST(ExchangeProperty, AllHoldTheSameWhoeverMeetsWhom) {
  EXPECT_TRUE(rc::check([] {
    std::deque<Robot> robots;
    for (std::uint16_t id = 0; id < kRobots; ++id) robots.emplace_back(static_cast<std::uint16_t>(id + 1));
    Radio radio(*rc::gen::inRange(0, 8) / 10.0, *rc::gen::arbitrary<unsigned>());
    double t = 0.0;
    const int phases = *rc::gen::inRange(1, 5);
    for (int phase = 0; phase < phases; ++phase) {
      std::array<int, kRobots> groups{};
      for (int& group : groups) group = *rc::gen::inRange(0, 3);
      radio.regroup(groups);
      for (int i = 0; i < 40; ++i, t += 0.05) {
        if (i % 8 == 0) RC_ASSERT(robots[static_cast<std::size_t>(i / 8) % kRobots].make(150));
        step(robots, radio, t, 6);
      }
    }
    radio.regroup({});
    const double end = t + 120.0;
    for (; t < end && !all_same(robots); t += 0.05) step(robots, radio, t, 6);
    RC_ASSERT(all_same(robots));
    RC_ASSERT(robots[0].exchange.items().size() > 0U);
    for (Robot& robot : robots) {
      RC_ASSERT(robot.exchange.counters().malformed == 0U);
      RC_ASSERT(robot.exchange.counters().malformed_item == 0U);
      RC_ASSERT(keyframes_of(robot.exchange.items()) == keyframes_of(robots[0].exchange.items()));
    }
  }));
}

/// All news of a robot, each keyframe and relation once.
TEST(ExchangeProperty, NewsHaveEachItemOfMatesOnce) {
  EXPECT_TRUE(rc::check([] {
    std::deque<Robot> robots;
    for (std::uint16_t id = 0; id < kRobots; ++id) robots.emplace_back(static_cast<std::uint16_t>(id + 1));
    Radio radio(0.3, *rc::gen::arbitrary<unsigned>());
    std::array<std::vector<slam::KeyframeId>, kRobots> told;
    double t = 0.0;
    for (int i = 0; i < 1'200 && (i < 100 || !all_same(robots)); ++i, t += 0.05) {
      if (i < 40 && i % 5 == 0) RC_ASSERT(robots[static_cast<std::size_t>(i) % kRobots].make(100));
      step(robots, radio, t, 4);
      for (std::size_t r = 0; r < kRobots; ++r) {
        for (const auto& keyframe : robots[r].exchange.take_news(at(t)).keyframes)
          told.at(r).push_back(keyframe->id);
      }
    }
    RC_ASSERT(all_same(robots));
    const std::size_t all = keyframes_of(robots[0].exchange.items()).size();
    for (std::size_t r = 0; r < kRobots; ++r) {
      auto& ids = told.at(r);
      std::sort(ids.begin(), ids.end());
      RC_ASSERT(std::adjacent_find(ids.begin(), ids.end()) == ids.end());
      RC_ASSERT(ids.size() == all - robots[r].made);
    }
  }));
}

/// Relations across the robots, so that one map holds all.
bool tie_to_first(Robot& robot) {
  const auto [team, id, run] = robot.exchange.identity();
  slam::FoundRelation found = testing::odometry({id, 1, run});
  found.id = {id, robot.made - 1, run};  // after those of odometry
  found.key = {{1, 0, 1}, {id, 0, run}};
  found.relation.T_from_to = {0.0, 2.0 * id, 0.0};
  return robot.exchange.add_relation(found).has_value();
}

TEST(ExchangeProperty, TheCanonicalMapIsTheSameToTheBit) {
  std::deque<Robot> robots;
  for (std::uint16_t id = 0; id < kRobots; ++id) {
    robots.emplace_back(static_cast<std::uint16_t>(id + 1));
    for (int i = 0; i < 3 + id; ++i) ASSERT_TRUE(robots.back().make(200));
    ASSERT_TRUE(id == 0 || tie_to_first(robots.back()));
  }
  Radio radio(0.3, 5);
  double t = 0.0;
  for (; t < 60.0 && !all_same(robots); t += 0.05) step(robots, radio, t, 5);
  ASSERT_TRUE(all_same(robots));
  const auto map_of = [](const Robot& robot) {
    const ItemStore& items = robot.exchange.items();
    return slam::canonical_map(keyframes_of(items), relations_of(items).relations(), {1, 0, 1}, {}, {});
  };
  const slam::CanonicalMap first = map_of(robots[0]);
  EXPECT_EQ(first.ids.size(), 3U + 4U + 5U + 6U);
  for (const Robot& robot : robots) {
    const slam::CanonicalMap map = map_of(robot);
    EXPECT_EQ(map.ids, first.ids);
    EXPECT_EQ(map.poses, first.poses);
    EXPECT_EQ(slam::testing::states(map.map->grid()), slam::testing::states(first.map->grid()));
    EXPECT_EQ(slam::testing::columns(map.map->walls()), slam::testing::columns(first.map->walls()));
  }
}

TEST(ExchangeProperty, PiecesOfTwoThatLostDifferentOnesArePaired) {
  Robot a(1), b(2), c(3);
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(a.make());
  std::mt19937 random(3);
  const auto lost = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random) < 0.3; };
  const std::array<Robot*, 3> all{&a, &b, &c};
  for (double t = 0.0; t < 30.0; t += 0.05) {
    for (Robot* from : all) {
      for (const Datagram& datagram : from->exchange.datagrams(at(t))) {
        for (Robot* to : all) {
          if (to != from && !lost()) to->exchange.take(datagram, at(t));
        }
      }
    }
  }
  EXPECT_EQ(a.exchange.items().hash(), b.exchange.items().hash());
  EXPECT_EQ(a.exchange.items().hash(), c.exchange.items().hash());
  const auto& bytes = a.exchange.counters().sent_bytes_of;
  EXPECT_GT(bytes.at(static_cast<std::size_t>(MessageKind::kCoded)),
            bytes.at(static_cast<std::size_t>(MessageKind::kPiece)) / 10);
}

}  // namespace
}  // namespace topo::team

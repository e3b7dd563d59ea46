// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/canonical_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>

#include "tests/unit/core/slam/graph_fixture.hpp"
#include "tests/unit/core/slam/map_contents.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// One thing that a robot sends to the others.
struct Sent {
  KeyframePtr keyframe;  ///< or null, and a relation
  RelationSet::Key key;
  Relation relation;
};

/// Two robots' paths through two rooms: measured a little wrongly from one keyframe to the next, starts that
/// are known, a closure between the robots and one within the first.
class TwoRobots {
 public:
  TwoRobots() {
    const std::vector<std::vector<Se2>> truth{
        {{2.0, 2.0, 0.0}, {2.6, 2.1, 0.3}, {3.4, 2.5, 0.5}, {5.0, 3.5, -0.5}, {8.5, 3.6, 0.1}},
        {{2.0, 3.0, 0.0}, {2.4, 3.2, 0.2}, {3.0, 3.4, 0.0}, {4.2, 3.5, -0.3}}};
    for (std::uint16_t robot = 0; robot < truth.size(); ++robot) {
      const std::vector<Se2>& way = truth[robot];
      for (std::uint32_t i = 0; i < way.size(); ++i) {
        add_keyframe({robot, i}, way[i]);
        if (i > 0) relate({robot, i - 1}, {robot, i}, way[i - 1], way[i], false);
      }
    }
    relate({0, 0}, {1, 0}, truth[0][0], truth[1][0], false);
    relate({0, 2}, {1, 2}, truth[0][2], truth[1][2], true);
    relate({0, 0}, {0, 3}, truth[0][0], truth[0][3], true);
  }

  std::vector<Sent> sent;

 private:
  void add_keyframe(const KeyframeId& id, const Se2& pose) {
    const testing::View view = testing::view_of(mocks::two_rooms(), pose, 0.01, random_);
    auto keyframe = std::make_shared<Keyframe>();
    keyframe->id = id;
    keyframe->content = CodedContent({view.cloud.points, {}, {}, {{1.0F, 0.5F, 7U << id.sequence}}});
    sent.push_back({std::move(keyframe), {}, {}});
  }
  void relate(const KeyframeId& from, const KeyframeId& to, const Se2& a, const Se2& b, bool robust) {
    std::normal_distribution<double> error(0.0, 0.02);
    Relation relation;
    relation.T_from_to = a.inverse() * b * Se2{error(random_), error(random_), 0.2 * error(random_)};
    relation.information = Eigen::Vector3d(2500.0, 2500.0, 60000.0).asDiagonal();
    relation.robust = robust;
    sent.push_back({nullptr, {from, to}, relation});
  }

  std::mt19937 random_{5};
};

struct Sets {
  KeyframeSet keyframes;
  RelationSet relations;
  void take(const Sent& sent) {
    if (sent.keyframe != nullptr)
      keyframes.insert(sent.keyframe);
    else
      relations.insert(sent.key, sent.relation);
  }
  void merge(const Sets& other) {
    keyframes.merge(other.keyframes);
    relations.merge(other.relations);
  }
  [[nodiscard]] CanonicalMap map() const { return canonical_map(keyframes, relations, {0, 0}, {}, {}); }
};

bool same(const CanonicalMap& a, const CanonicalMap& b) {
  return a.ids == b.ids && a.poses == b.poses &&
         testing::states(a.map->grid()) == testing::states(b.map->grid()) &&
         testing::columns(a.map->walls()) == testing::columns(b.map->walls());
}

TEST(CanonicalMap, isTheSameWhateverTheOrderAndRepetitionOfWhatCame) {
  const TwoRobots robots;
  Sets all;
  for (const Sent& sent : robots.sent) all.take(sent);
  const CanonicalMap expected = all.map();
  ASSERT_EQ(expected.ids.size(), 9U);
  ASSERT_GT(testing::states(expected.map->grid()).size(), 5000U);
  EXPECT_TRUE(rc::check("to the bit", [&] {
    std::vector<Sets> heard(3);  // by three robots, each some of it, some of it twice
    std::vector<Sent> jumbled = robots.sent;
    jumbled.insert(jumbled.end(), robots.sent.begin(), robots.sent.end());
    std::shuffle(jumbled.begin(), jumbled.end(), std::mt19937(*rc::gen::arbitrary<unsigned>()));
    for (const Sent& sent : jumbled) heard[*rc::gen::inRange<std::size_t>(0, 3)].take(sent);
    const std::size_t first = *rc::gen::inRange<std::size_t>(0, 3);
    Sets joined = heard[first];
    joined.merge(heard[(first + 1) % 3]);
    joined.merge(heard[(first + 2) % 3]);
    joined.merge(heard[first]);
    RC_ASSERT(joined.keyframes == all.keyframes);
    RC_ASSERT(same(joined.map(), expected));
  }));
}

/// Robots have other numbers, and the second of them has begun anew.
KeyframeId renumbered(const KeyframeId& id) {
  return id.robot == 0 ? KeyframeId{5, id.sequence + 3, 0} : KeyframeId{2, id.sequence, 9};
}

// The last keyframe of one robot and the first of the next are neighbours in the order of the keys: a
// relation between them is no odometry for that.
TEST(CanonicalMap, doesNotDependOnTheNumbersOfRobotsRunsAndKeyframes) {
  const TwoRobots robots;
  Sets all, other;
  for (const Sent& sent : robots.sent) {
    all.take(sent);
    Sent again = sent;
    if (sent.keyframe != nullptr) {
      auto keyframe = std::make_shared<Keyframe>(*sent.keyframe);
      keyframe->id = renumbered(keyframe->id);
      again.keyframe = std::move(keyframe);
    } else {
      again.key = {renumbered(sent.key.first), renumbered(sent.key.second)};
    }
    other.take(again);
  }
  const CanonicalMap expected = all.map();
  const CanonicalMap map = canonical_map(other.keyframes, other.relations, renumbered({0, 0}), {}, {});
  ASSERT_EQ(map.ids.size(), expected.ids.size());
  for (std::size_t i = 0; i < expected.ids.size(); ++i) {
    const auto at = std::lower_bound(map.ids.begin(), map.ids.end(), renumbered(expected.ids[i]));
    const Se2& pose = map.poses[static_cast<std::size_t>(at - map.ids.begin())];
    EXPECT_LT((pose.translation() - expected.poses[i].translation()).norm(), 1e-4) << i;
  }
}

TEST(CanonicalMap, leavesOutWhatNothingTiesToTheOrigin) {
  const TwoRobots robots;
  Sets own;
  for (const Sent& sent : robots.sent) {
    const bool between = sent.keyframe == nullptr && sent.key.first.robot != sent.key.second.robot;
    if (!between) own.take(sent);
  }
  const CanonicalMap first = own.map();
  EXPECT_EQ(first.ids.size(), 5U) << "the other robot is not in this map";
  EXPECT_EQ(first.poses.front(), Se2{});
  const CanonicalMap second = canonical_map(own.keyframes, own.relations, {1, 0}, {}, {});
  EXPECT_EQ(second.ids.size(), 4U);
  EXPECT_TRUE(canonical_map(own.keyframes, own.relations, {7, 0}, {}, {}).ids.empty());
}

TEST(CanonicalMap, isSolvedAndNotOnlyChained) {
  const TwoRobots robots;
  Sets all;
  for (const Sent& sent : robots.sent) all.take(sent);
  const CanonicalMap map = all.map();
  std::vector<Edge> edges;
  const auto node = [&](const KeyframeId& id) {
    return static_cast<std::size_t>(std::find(map.ids.begin(), map.ids.end(), id) - map.ids.begin());
  };
  for (const auto& [key, relation] : all.relations.relations())
    edges.push_back({node(key.first), node(key.second), relation.T_from_to, relation.information});
  const double least = total_chi2(map.poses, edges);
  EXPECT_GT(least, 0.0) << "ten relations of nine keyframes do not agree to the last bit";
  std::vector<Se2> others = map.poses;
  for (std::size_t i = 1; i < others.size(); ++i) {
    for (const Se2& push : {Se2{0.01, 0.0, 0.0}, Se2{0.0, 0.01, 0.0}, Se2{0.0, 0.0, 0.005}}) {
      others[i] = map.poses[i] * push;
      EXPECT_GT(total_chi2(others, edges), least);
      others[i] = map.poses[i] * push.inverse();
      EXPECT_GT(total_chi2(others, edges), least);
    }
    others[i] = map.poses[i];
  }
}

KeyframePtr nothing_seen(const KeyframeId& id) {
  auto keyframe = std::make_shared<Keyframe>();
  keyframe->id = id;
  return keyframe;
}

TEST(CanonicalSession, relationsThatAgreeGiveTheTruthFromAnyOrigin) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const std::size_t nodes = 2 + random() % 15;
    const auto truth = testing::random_poses(nodes, random);
    Sets sets;
    std::map<KeyframeId, std::size_t> node_of;
    std::vector<KeyframeId> ids;
    while (ids.size() < nodes) {
      const KeyframeId id{static_cast<std::uint16_t>(random() % 3),
                          static_cast<std::uint32_t>(random() % 40)};
      if (!node_of.try_emplace(id, ids.size()).second) continue;
      ids.push_back(id);
      sets.keyframes.insert(nothing_seen(id));
    }
    for (const auto& [from, to] : testing::random_ties(nodes, nodes, random)) {
      Relation relation;
      relation.T_from_to = truth[from].inverse() * truth[to];
      relation.robust = random() % 3 == 0;
      sets.relations.insert({ids[from], ids[to]}, relation);
    }
    sets.relations.insert({ids[0], {9, 0}}, {});  // a keyframe that nobody has sent
    const std::size_t origin = random() % nodes;
    const Session session = canonical_session(sets.keyframes, sets.relations, ids[origin], {});
    ASSERT_EQ(session.keyframes.size(), nodes);
    EXPECT_TRUE(check_session(session));
    std::size_t k = 0;
    for (const auto& [id, node] : node_of) {
      EXPECT_EQ(session.keyframes[k]->id, id) << "in the order of the keys";
      EXPECT_LT(testing::difference(session.poses[k], truth[origin].inverse() * truth[node]), 1e-6) << seed;
      if (node == origin) {
        EXPECT_EQ(session.poses[k], Se2{});
      }
      ++k;
    }
  }
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/unplaced.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

KeyframePtr bare_keyframe(const KeyframeId& id) {
  auto keyframe = std::make_shared<Keyframe>();
  keyframe->id = id;
  return keyframe;
}

KeyframeId any_id(std::mt19937& random) {
  return {static_cast<std::uint16_t>(random() % 2), static_cast<std::uint32_t>(random() % 6)};
}

std::set<RelationKey> keys_at(const Unplaced& unplaced, const KeyframeId& id) {
  const auto& keys = unplaced.at(id);
  const std::set<RelationKey> different(keys.begin(), keys.end());
  EXPECT_EQ(different.size(), keys.size()) << "no key twice";
  return different;
}

TEST(Unplaced, HoldsWhatCameAndHasNotLeft) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    Unplaced unplaced;
    std::map<KeyframeId, KeyframePtr> keyframes;
    std::map<RelationKey, double> relations;  // with their lengths
    for (int step = 0; step < 150; ++step) {
      const KeyframeId a = any_id(random), b = any_id(random);
      const auto action = random() % 4;
      if (action == 0) {
        const KeyframePtr keyframe = bare_keyframe(a);
        unplaced.add(keyframe);
        keyframes.try_emplace(a, keyframe);
      } else if (action == 1 && keyframes.contains(a)) {
        EXPECT_EQ(unplaced.take(a), keyframes.at(a)) << "the first that came";
        keyframes.erase(a);
      } else if (action == 2 && a != b) {
        Relation relation;
        relation.T_from_to.x_m = step;
        unplaced.add({{}, {a, b}, relation});
        relations.try_emplace({a, b}, step);
      } else if (action == 3) {
        unplaced.erase({a, b});  // which may not be there
        relations.erase({a, b});
      }
      ASSERT_EQ(unplaced.keyframes(), keyframes) << seed;
      EXPECT_EQ(unplaced.contains(a), keyframes.contains(a));
      const FoundRelation* found = unplaced.find({a, b});
      ASSERT_EQ(found != nullptr, relations.contains({a, b})) << seed;
      if (found != nullptr) {
        EXPECT_EQ(found->relation.T_from_to.x_m, relations.at({a, b}));
      }
      std::set<RelationKey> expected;
      for (const auto& [key, length] : relations)
        if (key.first == a || key.second == a) expected.insert(key);
      EXPECT_EQ(keys_at(unplaced, a), expected) << seed;
    }
  }
}

TEST(Unplaced, TiedToIsAMapOfThoseThatHangTogether) {
  std::mt19937 random(1);
  const std::vector<types::Se2> truth = testing::random_poses(6, random);
  Unplaced unplaced;
  const auto id = [](std::size_t i) { return KeyframeId{4, static_cast<std::uint32_t>(i)}; };
  for (std::size_t i = 0; i < truth.size(); ++i) unplaced.add(bare_keyframe(id(i)));
  const auto relate = [&](std::size_t from, std::size_t to) {
    Relation relation;
    relation.T_from_to = truth[from].inverse() * truth[to];
    unplaced.add({{}, {id(from), id(to)}, relation});
  };
  relate(0, 1);
  relate(3, 1);                             // against the way
  relate(4, 5);                             // of another piece
  unplaced.add({{}, {id(3), {9, 9}}, {}});  // whose other end is elsewhere
  const Session map = unplaced.tied_to(id(1), {});
  ASSERT_EQ(map.keyframes.size(), 3U);
  ASSERT_TRUE(check_session(map));
  const std::vector<std::size_t> expected{0, 1, 3};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(map.keyframes[k]->id, id(expected[k]));
    EXPECT_LT(testing::difference(map.poses[k], truth[1].inverse() * truth[expected[k]]), 1e-9);
  }
  EXPECT_EQ(unplaced.tied_to(id(4), {}).keyframes.size(), 2U);
  EXPECT_EQ(unplaced.tied_to(id(2), {}).keyframes.size(), 1U) << "alone";
  EXPECT_TRUE(unplaced.tied_to({9, 9}, {}).keyframes.empty()) << "it is not here";
  EXPECT_EQ(unplaced.keyframes().size(), 6U) << "nothing leaves by being looked at";
}

}  // namespace
}  // namespace topo::slam

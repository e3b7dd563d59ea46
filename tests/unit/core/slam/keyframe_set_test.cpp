// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/keyframe_set.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/unit/core/slam/keyframe_sample.hpp"

namespace topo::slam {
namespace {

KeyframePtr sample(std::uint16_t robot, std::uint32_t sequence, unsigned content) {
  std::mt19937 random(content);
  Keyframe keyframe = testing::random_keyframe(sequence, 3, random);
  keyframe.id = {robot, sequence};
  return std::make_shared<const Keyframe>(std::move(keyframe));
}

/// A few keyframes of a few robots, some keys with two contents, in any order and with repetition.
std::vector<KeyframePtr> arbitrary_keyframes() {
  std::vector<KeyframePtr> keyframes;
  for (int n = *rc::gen::inRange(0, 12); n > 0; --n) {
    const auto robot = static_cast<std::uint16_t>(*rc::gen::inRange(0, 3));
    const auto sequence = static_cast<std::uint32_t>(*rc::gen::inRange(0, 4));
    keyframes.push_back(sample(robot, sequence, static_cast<unsigned>(*rc::gen::inRange(0, 2))));
  }
  return keyframes;
}

KeyframeSet set_of(const std::vector<KeyframePtr>& keyframes) {
  KeyframeSet set;
  for (const KeyframePtr& keyframe : keyframes) set.insert(keyframe);
  return set;
}

KeyframeSet united(KeyframeSet a, const KeyframeSet& b) {
  a.merge(b);
  return a;
}

TEST(KeyframeSet, unionIsCommutativeAssociativeAndIdempotent) {
  EXPECT_TRUE(rc::check("a join-semilattice", [] {
    const KeyframeSet a = set_of(arbitrary_keyframes()), b = set_of(arbitrary_keyframes()),
                      c = set_of(arbitrary_keyframes());
    RC_ASSERT(united(a, b) == united(b, a));
    RC_ASSERT(united(united(a, b), c) == united(a, united(b, c)));
    RC_ASSERT(united(a, a) == a);
    KeyframeSet again = united(a, b);
    RC_ASSERT(!again.merge(a));
    for (const auto& [id, keyframe] : a.keyframes()) RC_ASSERT(again.contains(id));
  }));
}

TEST(KeyframeSet, orderAndRepetitionOfWhatComesDoNotMatter) {
  EXPECT_TRUE(rc::check("any order, any repetition", [] {
    const std::vector<KeyframePtr> once = arbitrary_keyframes();
    std::vector<KeyframePtr> jumbled = once;
    jumbled.insert(jumbled.end(), once.begin(), once.end());
    std::shuffle(jumbled.begin(), jumbled.end(), std::mt19937(*rc::gen::arbitrary<unsigned>()));
    RC_ASSERT(set_of(jumbled) == set_of(once));
  }));
}

TEST(KeyframeSet, whatIsMissingThereMakesTheSetsEqual) {
  EXPECT_TRUE(rc::check("exchange until nobody lacks anything", [] {
    // One content for each key: frozen, as it should be.
    const auto some = [] {
      KeyframeSet set;
      for (const KeyframePtr& k : arbitrary_keyframes()) set.insert(sample(k->id.robot, k->id.sequence, 7));
      return set;
    };
    KeyframeSet here = some(), there = some();
    const KeyframeSet both = united(here, there);
    const auto send = [](const KeyframeSet& from, KeyframeSet& to) {
      for (const KeyframePtr& keyframe : from.missing(to.counts(), 1000)) to.insert(keyframe);
    };
    send(here, there);
    send(there, here);
    RC_ASSERT(here == both);
    RC_ASSERT(there == both);
  }));
}

TEST(KeyframeSet, countsEndAtTheFirstGapAndMissingIsBounded) {
  const KeyframeSet set =
      set_of({sample(1, 0, 0), sample(1, 1, 0), sample(1, 3, 0), sample(4, 2, 0), sample(6, 0, 0)});
  const std::vector<OriginCount> expected{{1, 2}, {4, 0}, {6, 1}};
  EXPECT_EQ(set.counts(), expected);
  EXPECT_EQ(set.missing({}, 100).size(), 5U);
  const std::vector<OriginCount> there{{1, 2}, {4, 3}};
  const auto missing = set.missing(there, 100);
  ASSERT_EQ(missing.size(), 2U);
  EXPECT_EQ(missing[0]->id, (KeyframeId{1, 3}));
  EXPECT_EQ(missing[1]->id, (KeyframeId{6, 0}));
  EXPECT_EQ(set.missing(there, 1).size(), 1U);
  EXPECT_EQ(set.find({4, 2})->id.sequence, 2U);
  EXPECT_EQ(set.find({4, 3}), nullptr);
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/relation_set.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace topo::slam {
namespace {

FoundRelation told(std::uint16_t robot, std::uint32_t number, std::uint32_t run, double x_m) {
  FoundRelation out;
  out.id = {robot, number, run};
  out.key = {{robot, number, run}, {robot, number + 1, run}};
  out.relation.T_from_to = {x_m, 0.0, 0.0};
  return out;
}

bool same(const RelationSet& a, const RelationSet& b) {
  return std::equal(a.relations().begin(), a.relations().end(), b.relations().begin(), b.relations().end(),
                    [](const auto& x, const auto& y) {
                      return x.first == y.first && x.second.T_from_to == y.second.T_from_to &&
                             x.second.information == y.second.information &&
                             x.second.robust == y.second.robust;
                    });
}

/// Of two robots, one of which ran twice; some under one key with different numbers.
std::vector<FoundRelation> sample() {
  std::vector<FoundRelation> all;
  for (std::uint32_t i = 0; i < 8; ++i) {
    all.push_back(told(0, i, 0, 0.4));
    all.push_back(told(1, i, 7, 0.5));
    all.push_back(told(1, i, 9, 0.6));
  }
  FoundRelation other = told(0, 20, 0, 0.3);  // another's word on the same two keyframes
  other.key = all.front().key;
  all.push_back(other);
  all.push_back(told(0, 3, 0, 0.1));  // the same number told twice and not alike
  return all;
}

TEST(RelationLog, isTheSameWhateverTheOrderAndRepetitionOfWhatCame) {
  RelationLog expected;
  for (const FoundRelation& one : sample()) expected.insert(one);
  EXPECT_EQ(expected.size(), 25U);
  EXPECT_TRUE(rc::check("in any order, any of it twice, by way of two logs", [&] {
    std::vector<FoundRelation> jumbled = sample();
    const std::vector<FoundRelation> again = sample();
    jumbled.insert(jumbled.end(), again.begin(), again.end());
    std::shuffle(jumbled.begin(), jumbled.end(), std::mt19937(*rc::gen::arbitrary<unsigned>()));
    RelationLog a, b;
    for (const FoundRelation& one : jumbled) (*rc::gen::arbitrary<bool>() ? a : b).insert(one);
    for (const FoundRelation& one : b.missing({}, 1000)) a.insert(one);
    RC_ASSERT(a.size() == expected.size());
    RC_ASSERT(a.counts() == expected.counts());
    RC_ASSERT(same(a.relations(), expected.relations()));
  }));
}

TEST(RelationLog, sendsWhatIsMissingAndNoMore) {
  RelationLog here, there;
  for (const FoundRelation& one : sample()) here.insert(one);
  for (int rounds = 0; there.size() < here.size(); ++rounds) {
    ASSERT_LT(rounds, 30);
    const std::vector<FoundRelation> letter = here.missing(there.counts(), 4);
    ASSERT_LE(letter.size(), 4U);
    ASSERT_FALSE(letter.empty());
    for (const FoundRelation& one : letter) there.insert(one);
  }
  const std::vector<OriginCount> counts{{0, 8, 0}, {1, 8, 7}, {1, 8, 9}};
  EXPECT_EQ(there.counts(), counts) << "number 20 lies beyond a gap";
}

TEST(RelationSet, keepsTheRunsOfOneRobotApart) {
  RelationSet set;
  for (const FoundRelation& one : sample()) set.insert(one.key, one.relation);
  EXPECT_EQ(set.relations().size(), 24U);
  EXPECT_EQ((set.relations().at({{1, 2, 7}, {1, 3, 7}}).T_from_to.x_m), 0.5);
  EXPECT_EQ((set.relations().at({{1, 2, 9}, {1, 3, 9}}).T_from_to.x_m), 0.6);
}

TEST(CheckRelation, namesTheFault) {
  const FoundRelation good = told(2, 5, 0, 0.4);
  EXPECT_TRUE(check_relation(good));
  for (const auto spoil : {+[](FoundRelation& r) { r.key.second = r.key.first; },
                           +[](FoundRelation& r) { r.relation.T_from_to.y_m = 1e9; },
                           +[](FoundRelation& r) { r.relation.information(0, 1) = 3.0; },
                           +[](FoundRelation& r) { r.relation.information(1, 1) = -1.0; },
                           +[](FoundRelation& r) {
                             r.relation.T_from_to.theta_rad = std::numeric_limits<double>::quiet_NaN();
                           }}) {
    FoundRelation wrong = good;
    spoil(wrong);
    const auto refused = check_relation(wrong);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message.find("relation 5 of robot 2: "), 0U) << refused.error().message;
  }
}

/// Relations of a few keys with a few contents, which may differ in any one of their numbers.
RelationSet random_relations(std::mt19937& random) {
  RelationSet set;
  for (std::size_t k = random() % 12; k > 0; --k) {
    const KeyframeId a{0, static_cast<std::uint32_t>(random() % 3)},
        b{1, static_cast<std::uint32_t>(random() % 3)};
    Relation relation;
    relation.T_from_to.y_m = static_cast<double>(random() % 2);
    relation.information(2, 2) = 1.0 + static_cast<double>(random() % 2);
    relation.robust = random() % 2 == 0;
    set.insert({a, b}, relation);
  }
  return set;
}

RelationSet united(RelationSet a, const RelationSet& b) {
  a.merge(b);
  return a;
}

TEST(RelationSet, unionIsCommutativeAssociativeAndIdempotent) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const RelationSet a = random_relations(random), b = random_relations(random),
                      c = random_relations(random);
    EXPECT_TRUE(same(united(a, b), united(b, a))) << seed;
    EXPECT_TRUE(same(united(united(a, b), c), united(a, united(b, c)))) << seed;
    EXPECT_TRUE(same(united(a, a), a)) << seed;
    RelationSet both = united(a, b);
    EXPECT_FALSE(both.merge(a)) << "it has changed nothing";
    EXPECT_EQ(united(a, b).relations().size() != a.relations().size() || !same(both, a),
              RelationSet(a).merge(b));
  }
}

TEST(CheckRelation, takesWhatIsAtTheBounds) {
  FoundRelation found = told(2, 5, 0, 1e4);
  found.relation.T_from_to.theta_rad = -1e4;
  found.relation.information = Eigen::Matrix3d::Zero();
  EXPECT_TRUE(check_relation(found)) << "no information is information";
  found.relation.T_from_to.x_m = 1e4 + 1.0;
  EXPECT_FALSE(check_relation(found));
  found = told(2, 5, 0, 0.0);
  found.key.second = {2, 5, 1};  // the same number in another run
  EXPECT_TRUE(check_relation(found));
  for (const double wrong : {HUGE_VAL, -HUGE_VAL, std::numeric_limits<double>::quiet_NaN()}) {
    FoundRelation spoilt = found;
    spoilt.relation.information(2, 2) = wrong;
    EXPECT_FALSE(check_relation(spoilt)) << wrong;
  }
}

}  // namespace
}  // namespace topo::slam

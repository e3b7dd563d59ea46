// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "core/slam/canonical_map.hpp"
#include "core/slam/known_starts.hpp"
#include "tests/unit/core/slam/team_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// Two robots that went through the two rooms on different ways and have told one another nothing yet.
struct TwoMappers {
  TwoMappers() {
    testing::drive(first, world, first_way, random);
    testing::drive(second, world, second_way, random);
  }
  [[nodiscard]] std::pair<RelationKey, Relation> known(const Se2& error = {}) const {
    return known_starts({0, 0}, Se2{}, {1, 0}, first_way.front().inverse() * second_way.front() * error);
  }
  /// The worst place that a map has for a keyframe of the second robot.
  [[nodiscard]] double worst_of_second(const Mapper& mapper) const {
    double worst_m = 0.0;
    for (std::size_t i = 0; i < second.keyframes().size(); ++i) {
      const auto node = mapper.node_of(second.keyframes()[i]->id);
      if (!node) return HUGE_VAL;
      const Se2 truth = first_way.front().inverse() * second_way.front() * second.poses()[i];
      worst_m = std::max(worst_m, (mapper.poses()[*node].translation() - truth.translation()).norm());
    }
    return worst_m;
  }
  /// What the second one tells joins the first one's map, with the matches that come of it.
  void match_mates() {
    for (auto queries = first.take_mate_queries(4); !queries.empty(); queries = first.take_mate_queries(4)) {
      for (const LoopQuery& query : queries) (void)first.apply(find_closures(query));
    }
    (void)first.optimise();
  }

  mocks::FlatWorld world = mocks::two_rooms();
  std::mt19937 random{1};
  std::vector<Se2> first_way = testing::legs({{1.5, 1.5}, {5.0, 1.5}, {5.0, 3.6}, {9.0, 3.6}});
  std::vector<Se2> second_way = testing::legs({{1.5, 3.6}, {9.0, 3.6}, {9.0, 6.0}});
  Mapper first{MapperParams{}, {0, 0}};
  Mapper second{MapperParams{}, {1, 0}};
};

TEST(MapperTeam, whatNothingTiesToTheMapWaits) {
  TwoMappers robots;
  const std::size_t before = robots.first.keyframes().size();
  const Se2 stands = robots.first.T_map_base();
  const JoinVerdict verdict = robots.first.join(robots.second.keyframes(), robots.second.found_since(0));
  EXPECT_EQ(verdict.placed, 0);
  EXPECT_EQ(robots.first.keyframes().size(), before);
  EXPECT_EQ(robots.first.T_map_base(), stands);
  const auto known = robots.known();
  const JoinVerdict tied = robots.first.relate(known.first, known.second);
  EXPECT_EQ(tied.placed, static_cast<int>(robots.second.keyframes().size()));
  EXPECT_EQ(robots.first.relate(known.first, known.second).tied, 0) << "said twice";
  EXPECT_LT(robots.worst_of_second(robots.first), 0.06);
}

TEST(MapperTeam, startsThatWereSaidWronglyAreRefinedByMatching) {
  TwoMappers robots;
  const auto known = robots.known({0.15, -0.10, 0.03});
  robots.first.relate(known.first, known.second);
  robots.first.join(robots.second.keyframes(), robots.second.found_since(0));
  const double before_m = robots.worst_of_second(robots.first);
  EXPECT_GT(before_m, 0.15);
  robots.match_mates();
  EXPECT_LT(robots.worst_of_second(robots.first), 0.06);
}

TEST(MapperTeam, takesKeyframesAndRelationsInAnyOrder) {
  TwoMappers robots;
  const auto known = robots.known();
  robots.second.relate(known.first, known.second);
  struct Parcel {
    KeyframePtr keyframe;
    std::vector<FoundRelation> relation;
  };
  std::vector<Parcel> all;
  for (const KeyframePtr& keyframe : robots.second.keyframes()) all.push_back({keyframe, {}});
  for (const FoundRelation& found : robots.second.found_since(0)) all.push_back({nullptr, {found}});
  all.insert(all.end(), all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2));
  EXPECT_TRUE(rc::check("the same keyframes and as many edges, none where it is not", [&] {
    Mapper mapper = robots.first;
    std::vector<Parcel> jumbled = all;
    std::shuffle(jumbled.begin(), jumbled.end(), std::mt19937(*rc::gen::arbitrary<unsigned>()));
    for (const Parcel& sent : jumbled) {
      if (sent.keyframe != nullptr)
        mapper.join({&sent.keyframe, 1}, {});
      else
        mapper.join({}, sent.relation);
    }
    (void)mapper.optimise();
    RC_ASSERT(mapper.keyframes().size() ==
              robots.first.keyframes().size() + robots.second.keyframes().size());
    RC_ASSERT(mapper.edges().size() == robots.first.edges().size() + robots.second.found_since(0).size());
    RC_ASSERT(robots.worst_of_second(mapper) < 0.06);
    RC_ASSERT(mapper.own_way().size() == robots.first.own_way().size());
  }));
}

TEST(MapperTeam, ofTwoMatchesOfOnePairTheLowerOneIsKept) {
  TwoMappers robots;
  const auto known = robots.known();
  Relation lower = known.second, higher = known.second;
  lower.T_from_to.x_m -= 0.01;
  higher.T_from_to.x_m += 0.01;
  const auto of = [&](std::uint16_t finder, const Relation& relation) {
    return FoundRelation{{finder, 500, 0}, known.first, relation};
  };
  const auto kept_in = [&](const Mapper& mapper) {
    for (const Edge& edge : mapper.edges()) {
      const RelationKey key{mapper.keyframes()[edge.from]->id, mapper.keyframes()[edge.to]->id};
      if (key == known.first) return std::pair(edge.T_from_to.x_m, edge.finder.robot);
    }
    return std::pair(std::nan(""), std::uint16_t{0});
  };
  const std::vector<FoundRelation> rising{of(1, lower), of(2, higher)}, falling{of(2, higher), of(1, lower)};
  for (const auto& order : {rising, falling}) {
    for (const bool keyframes_first : {true, false}) {
      Mapper mapper = robots.first;
      if (keyframes_first) mapper.join(robots.second.keyframes(), {});
      mapper.join({}, {&order[0], 1});
      mapper.join({}, {&order[1], 1});
      if (!keyframes_first) mapper.join(robots.second.keyframes(), {});
      EXPECT_EQ(kept_in(mapper), std::pair(lower.T_from_to.x_m, std::uint16_t{1})) << keyframes_first;
    }
  }
}

TEST(MapperTeam, joinedMapsHaveOneCanonicalMapOnEitherSide) {
  TwoMappers robots;
  const auto known = robots.known();
  const auto tell = [&](Mapper& to, const Mapper& from) {
    to.join(from.keyframes(), from.found_since(0));  // what it has of others is known already
    to.relate(known.first, known.second);
  };
  tell(robots.first, robots.second);
  const Mapper& first = robots.first;
  KeyframeSet keyframes;
  RelationLog log;
  for (const KeyframePtr& keyframe : first.keyframes()) keyframes.insert(keyframe);
  for (const FoundRelation& found : first.found_since(0)) log.insert(found);
  for (const FoundRelation& found : robots.second.found_since(0)) log.insert(found);
  const Session canonical = canonical_session(keyframes, log.relations(), {0, 0}, {});
  ASSERT_EQ(canonical.keyframes.size(), first.keyframes().size());
  (void)robots.first.optimise();
  for (std::size_t i = 0; i < canonical.keyframes.size(); ++i) {
    const Se2& here = first.poses()[*first.node_of(canonical.keyframes[i]->id)];
    EXPECT_LT((canonical.poses[i].translation() - here.translation()).norm(), 0.002) << i;
  }
}

// A robot whose program began anew counts from 0 again; its run tells the two apart.
TEST(MapperTeam, anEarlierRunOfItsOwnIsATeamMateLikeAnother) {
  TwoMappers robots;
  Mapper again(MapperParams{}, {0, 1});
  testing::drive(again, robots.world, robots.second_way, robots.random);
  EXPECT_EQ(again.keyframes().front()->id, (KeyframeId{0, 0, 1}));
  again.join(robots.first.keyframes(), robots.first.found_since(0));
  const auto known = known_starts({0, 0, 0}, Se2{}, {0, 0, 1},
                                  robots.first_way.front().inverse() * robots.second_way.front());
  EXPECT_EQ(again.relate(known.first, known.second).placed,
            static_cast<int>(robots.first.keyframes().size()));
  EXPECT_EQ(again.mates_ways().size(), 1U);
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/placement.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/core/slam/twin_session.hpp"

namespace topo::slam {
namespace {

using types::Se2;

constexpr Se2 kInTheFirst{2.5, 7.5, 1.0}, kInTheSecond{10.5, 7.5, 1.0};  // see nothing but their room

TEST(PlaceDoubt, IsTheGravestOfWhatIsKnown) {
  constexpr std::size_t kLarge = 30, kSmall = 29, kEleven = 11;
  const PlacementCase plain{}, area{std::nullopt, true, false}, dropped{std::nullopt, false, true},
      both{std::nullopt, true, true}, given{Se2{}, true, true};
  struct Row {
    LocaliseRefusal searched;
    std::size_t keyframes;
    PlacementCase known;
    PlaceDoubt doubt;
  };
  const std::vector<Row> rows{
      {LocaliseRefusal::kNone, kLarge, plain, PlaceDoubt::kNone},
      {LocaliseRefusal::kNone, kSmall, plain, PlaceDoubt::kSmallMap},
      {LocaliseRefusal::kNone, kEleven, plain, PlaceDoubt::kSmallMap},
      {LocaliseRefusal::kNone, kLarge, area, PlaceDoubt::kAreaLimits},
      {LocaliseRefusal::kNone, kSmall, area, PlaceDoubt::kAreaLimits},
      {LocaliseRefusal::kNone, kLarge, dropped, PlaceDoubt::kDroppedBefore},
      {LocaliseRefusal::kNone, kSmall, both, PlaceDoubt::kDroppedBefore},
      {LocaliseRefusal::kAmbiguous, kLarge, plain, PlaceDoubt::kLooksAlike},
      {LocaliseRefusal::kAmbiguous, kEleven, both, PlaceDoubt::kLooksAlike},
      {LocaliseRefusal::kDegenerate, kLarge, plain, PlaceDoubt::kAlongAWall},
      {LocaliseRefusal::kTooLarge, kLarge, area, PlaceDoubt::kNotSearched},
      {LocaliseRefusal::kNone, kEleven, given, PlaceDoubt::kNone},
      {LocaliseRefusal::kAmbiguous, kLarge, given, PlaceDoubt::kNone},
  };
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_EQ(doubt_about(rows[i].searched, rows[i].keyframes, rows[i].known), rows[i].doubt) << "row " << i;
}

TEST(PlaceDoubt, HasAReasonOfItsOwn) {
  EXPECT_EQ(to_text(PlaceDoubt::kNone), "");
  std::set<std::string_view> reasons;
  for (const PlaceDoubt doubt :
       {PlaceDoubt::kLooksAlike, PlaceDoubt::kAlongAWall, PlaceDoubt::kNotSearched,
        PlaceDoubt::kDroppedBefore, PlaceDoubt::kAreaLimits, PlaceDoubt::kSmallMap}) {
    EXPECT_FALSE(to_text(doubt).empty());
    EXPECT_TRUE(reasons.insert(to_text(doubt)).second) << to_text(doubt);
  }
}

/// The session's path ends in the second room.
TEST(Placement, OfTwinsBothAreNamedAndTheEndProposed) {
  testing::TwinSession twins;
  for (const Se2& place : {kInTheFirst, kInTheSecond}) {
    const Placement found = place_in(twins.session, twins.view(place).cloud, {}, {});
    ASSERT_TRUE(found.found()) << describe(found);
    EXPECT_FALSE(found.is_fact());
    EXPECT_EQ(found.doubt, PlaceDoubt::kLooksAlike);
    EXPECT_LT(distance_m(found.place.match.T_map_base, twins.in_map(kInTheSecond)), 0.1) << describe(found);
    ASSERT_EQ(found.others.size(), 1U);
    EXPECT_LT(distance_m(found.others.front().T_map_base, twins.in_map(kInTheFirst)), 0.1);
    EXPECT_NE(describe(found).find("another place looks alike"), std::string::npos);
    EXPECT_NE(describe(found).find(describe_pose(found.others.front())), std::string::npos);
  }
}

/// The newest keyframe is of a team-mate, in the first room.
TEST(Placement, OfTwinsThatAtTheEndOfTheOwnPathIsProposedWhereverMatesAre) {
  testing::TwinSession twins;
  auto mates = std::make_shared<Keyframe>(*twins.session.keyframes.front());
  mates->id = {7, 0, 1};
  twins.session.keyframes.push_back(std::move(mates));
  twins.session.poses.push_back(twins.in_map(kInTheFirst));
  for (const Se2& place : {kInTheFirst, kInTheSecond}) {
    const Placement found = place_in(twins.session, twins.view(place).cloud, {}, {});
    ASSERT_TRUE(found.found()) << describe(found);
    EXPECT_LT(distance_m(found.place.match.T_map_base, twins.in_map(kInTheSecond)), 0.1) << describe(found);
  }
  const Placement of_the_mate =
      place_in(twins.session, twins.view(kInTheFirst).cloud, {std::nullopt, false, false, 7}, {});
  EXPECT_LT(distance_m(of_the_mate.place.match.T_map_base, twins.in_map(kInTheFirst)), 0.1);
}

TEST(Placement, AGivenPoseIsAFactWhoseRivalIsKnown) {
  testing::TwinSession twins;
  const Placement given =
      place_in(twins.session, twins.view(kInTheFirst).cloud, {twins.in_map(kInTheFirst), true, true}, {});
  ASSERT_TRUE(given.is_fact()) << describe(given);
  EXPECT_LT(distance_m(given.place.match.T_map_base, twins.in_map(kInTheFirst)), 0.1);
  ASSERT_EQ(given.others.size(), 1U);
  EXPECT_LT(distance_m(given.others.front().T_map_base, twins.in_map(kInTheSecond)), 0.1);
  const Placement wrong =
      place_in(twins.session, twins.view(kInTheFirst).cloud, {Se2{40.0, 40.0, 0.0}, false, false}, {});
  EXPECT_FALSE(wrong.found());
  EXPECT_FALSE(wrong.is_fact());
}

TEST(Placement, OfOneItsOwnKindIsAFactUnlessMoreIsAtStake) {
  testing::TwinSession twins;
  const Cloud cloud = twins.view({5.0, 1.4, 0.0}).cloud;  // the corridor, whose ends differ
  EXPECT_TRUE(place_in(twins.session, cloud, {}, {}).is_fact());
  EXPECT_EQ(place_in(twins.session, cloud, {std::nullopt, true, false}, {}).doubt, PlaceDoubt::kAreaLimits);
  Session small = twins.session;
  small.edges.clear();
  small.keyframes.resize(29);
  small.poses.resize(29);
  const Placement found = place_in(small, twins.view(kInTheSecond).cloud, {}, {});
  ASSERT_TRUE(found.found()) << "the twin's map fits";
  EXPECT_TRUE(found.others.empty());
  EXPECT_EQ(found.doubt, PlaceDoubt::kSmallMap);
}

TEST(Placement, WithoutAMapThereIsNone) {
  const Placement none = place_in({}, {}, {}, {});
  EXPECT_FALSE(none.found());
  EXPECT_EQ(none.place.refusal, LocaliseRefusal::kNoMap);
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/localise.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/slam/mapper.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// A mapper that was driven along true poses with true odometry; map is the world.
Mapper driven(const mocks::FlatWorld& world, const std::vector<Se2>& way, std::mt19937& random) {
  Mapper mapper({});
  walls::ColumnCollector columns({});
  for (const Se2& pose : way)
    (void)mapper.add(testing::view_of(world, pose, 0.01, random).cloud, way.front().inverse() * pose,
                     columns);
  return mapper;
}

/// A turn on the spot, so that the scanner's blind third is seen too.
void look_round(std::vector<Se2>& way, Se2 pose) {
  for (int i = 0; i < 25; ++i, pose.theta_rad = types::wrap_angle(pose.theta_rad + 0.08 * std::numbers::pi))
    way.push_back(pose);
}

std::vector<Se2> through_two_rooms() {
  std::vector<Se2> way;
  look_round(way, {1.5, 3.6, 0.0});
  for (int i = 0; i <= 30; ++i) way.push_back({1.5 + 0.12 * i, 3.6, 0.0});
  for (int i = 1; i <= 40; ++i) way.push_back({5.1 + 0.12 * i, 3.6, 0.0});
  look_round(way, way.back());
  return way;
}

/// Pose of the session's map that a pose of the world is.
Se2 in_map(const std::vector<Se2>& way, const Se2& pose) { return way.front().inverse() * pose; }

void expect_near(const Se2& a, const Se2& b) {
  EXPECT_LT((a.translation() - b.translation()).norm(), 0.05);
  EXPECT_LT(std::abs(types::wrap_angle(a.theta_rad - b.theta_rad)), 0.02);
}

const std::vector<Se2> kPlaces{
    {1.2, 6.5, 2.0}, {5.5, 1.5, -1.4}, {8.0, 6.5, 3.1}, {11.0, 3.5, 0.4}, {3.0, 3.0, -2.9}};

TEST(Localise, FindsItselfAnywhere) {
  const auto world = mocks::two_rooms();
  std::mt19937 random(1);
  const auto way = through_two_rooms();
  const Session session = driven(world, way, random).session();
  for (const Se2& place : kPlaces) {
    const auto view = testing::view_of(world, place, 0.02, random);
    const Localisation found = localise_anywhere(session, view.cloud, {});
    ASSERT_TRUE(found.found()) << describe(found);
    expect_near(found.match.T_map_base, in_map(way, place));
  }
}

TEST(Localise, FindsItselfNearAGivenPose) {
  const auto world = mocks::two_rooms();
  std::mt19937 random(2);
  const auto way = through_two_rooms();
  const Session session = driven(world, way, random).session();
  for (const Se2& place : kPlaces) {
    const auto view = testing::view_of(world, place, 0.02, random);
    const Se2 guess = in_map(way, {place.x_m + 0.9, place.y_m - 0.6, place.theta_rad + 0.4});
    const Localisation found = localise_near(session, view.cloud, guess, {});
    ASSERT_TRUE(found.found()) << describe(found);
    expect_near(found.match.T_map_base, in_map(way, place));
  }
}

TEST(Localise, TwoPlacesThatLookAlikeAreRefused) {
  const auto world = mocks::twin_rooms();
  std::mt19937 random(3);
  std::vector<Se2> way;
  look_round(way, {3.5, 7.0, -1.57});
  for (int i = 0; i <= 40; ++i) way.push_back({3.5, 7.0 - 0.14 * i, -1.57});
  for (int i = 0; i <= 60; ++i) way.push_back({3.5 + 8.0 * i / 60, 1.4, 0.0});
  for (int i = 0; i <= 40; ++i) way.push_back({11.5, 1.4 + 0.14 * i, 1.57});
  look_round(way, way.back());
  const Session session = driven(world, way, random).session();
  const Se2 place{2.5, 7.5, -0.6};  // sees nothing but its room
  const auto view = testing::view_of(world, place, 0.01, random);
  const Localisation found = localise_anywhere(session, view.cloud, {});
  EXPECT_EQ(found.refusal, LocaliseRefusal::kAmbiguous) << describe(found);
  ASSERT_EQ(found.rivals.size(), 1U);
  const double apart =
      (found.match.T_map_base.translation() - found.rivals.front().T_map_base.translation()).norm();
  EXPECT_NEAR(apart, 8.0, 0.2);
  // Who is told where it is about knows.
  const Localisation told = localise_near(session, view.cloud, in_map(way, {2.0, 7.0, -0.4}), {});
  ASSERT_TRUE(told.found()) << describe(told);
  expect_near(told.match.T_map_base, in_map(way, place));
}

TEST(Localise, AnotherBuildingIsRefused) {
  std::mt19937 random(4);
  const Session session = driven(mocks::two_rooms(), through_two_rooms(), random).session();
  mocks::FlatWorld other;
  other.box(0.0, 0.0, 31.0, 2.2);
  other.box(4.0, 0.8, 4.4, 1.2);
  const auto view = testing::view_of(other, {9.0, 1.1, 0.2}, 0.01, random);
  EXPECT_EQ(localise_anywhere(session, view.cloud, {}).refusal, LocaliseRefusal::kNothingFits);
  EXPECT_EQ(localise_near(session, view.cloud, {2.0, 0.0, 0.0}, {}).refusal, LocaliseRefusal::kNothingFits);
}

TEST(Localise, WithoutAMapOrAScanNothingIsFound) {
  const Cloud blind;
  EXPECT_EQ(localise_anywhere({}, blind, {}).refusal, LocaliseRefusal::kNoMap);
  EXPECT_EQ(localise_near({}, blind, {}, {}).refusal, LocaliseRefusal::kNoMap);
  std::mt19937 random(5);
  const Session session = driven(mocks::two_rooms(), through_two_rooms(), random).session();
  EXPECT_EQ(localise_anywhere(session, blind, {}).refusal, LocaliseRefusal::kNothingFits);
  EXPECT_EQ(localise_near(session, blind, {}, {}).refusal, LocaliseRefusal::kNothingFits);
  EXPECT_FALSE(describe(localise_near(session, blind, {}, {})).empty());
}

TEST(Localise, MapsThatAreTooLargeAreRefused) {
  std::mt19937 random(6);
  Session session = driven(mocks::two_rooms(), through_two_rooms(), random).session();
  session.poses.back().x_m += 5000.0;
  const auto view = testing::view_of(mocks::two_rooms(), kPlaces[0], 0.02, random);
  EXPECT_EQ(localise_anywhere(session, view.cloud, {}).refusal, LocaliseRefusal::kTooLarge);
}

TEST(Describe, SaysOfEachOutcomeSomethingElse) {
  Localisation out;
  out.match.T_map_base = {1.25, -3.5, 0.5};
  out.match.response = 0.83;
  std::set<std::string> sentences;
  for (const LocaliseRefusal refusal :
       {LocaliseRefusal::kNone, LocaliseRefusal::kNoMap, LocaliseRefusal::kTooLarge,
        LocaliseRefusal::kNothingFits, LocaliseRefusal::kDegenerate, LocaliseRefusal::kAmbiguous}) {
    out.refusal = refusal;
    EXPECT_EQ(out.found(), refusal == LocaliseRefusal::kNone);
    const std::string text = describe(out);
    EXPECT_TRUE(sentences.insert(text).second) << text;
    const bool was_searched = refusal != LocaliseRefusal::kNoMap && refusal != LocaliseRefusal::kTooLarge;
    EXPECT_EQ(text.find("x 1.25 y -3.50 theta 0.50 (83 % of the scan fits)") != std::string::npos,
              was_searched)
        << text;
  }
  out.rivals = {out.match};
  out.rivals.front().T_map_base.x_m = 9.75;
  EXPECT_NE(describe(out).find("x 9.75"), std::string::npos) << "the other of two places is named";
}

}  // namespace
}  // namespace topo::slam

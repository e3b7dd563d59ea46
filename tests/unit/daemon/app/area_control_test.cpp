// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/area_control.hpp"

#include <gmock/gmock.h>
#include <poll.h>

#include <memory>
#include <vector>

#include "drivers/io/posix.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;

const types::Polygon kCordon{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}};

class AreaControlTest : public ::testing::Test {
 protected:
  AreaControlTest() { EXPECT_TRUE(files.start("files")); }
  std::unique_ptr<AreaControl> make(const std::string& where) {
    auto areas = std::make_unique<AreaControl>(configured, *hand_overs, files, where,
                                               [this](const Json& event) { events.push_back(event); });
    areas->start();
    return areas;
  }
  void settle(const AreaControl& areas) {
    const types::Stamp limit = io::monotonic_now() + std::chrono::seconds(20);
    while (areas.json()["kept"] != true && areas.trouble().empty() &&
           io::wait_for(files.fd(), POLLIN, limit - io::monotonic_now()) > 0)
      files.collect();
  }

  testing::TempDir folder;
  types::AreaLimits configured;
  std::unique_ptr<HandOvers> hand_overs = std::make_unique<HandOvers>();
  Background files;
  std::vector<Json> events;
};

TEST_F(AreaControlTest, IsInForceForBaseAndPlanningAtOnce) {
  const auto areas = make(folder.str());
  EXPECT_FALSE(hand_overs->place.limited.load());
  EXPECT_EQ(areas->draw(kCordon).value_or(""), "1");
  for (auto* reader : {&hand_overs->area, &hand_overs->to_planning.area}) {
    const types::AreaLimits* limits = reader->read();
    ASSERT_NE(limits, nullptr);
    EXPECT_EQ(limits->keep_out, std::vector<types::Polygon>{kCordon});
  }
  EXPECT_TRUE(hand_overs->place.limited.load());
  ASSERT_NE(hand_overs->team.areas.read(), nullptr);
  EXPECT_EQ(hand_overs->team.areas.read()->own.size(), 1U);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events.front()["event"], "area");
  EXPECT_EQ(events.front()["corners_m"].size(), 3U);
}

TEST_F(AreaControlTest, AnAreaToGoToFirstLimitsNothing) {
  auto areas = make(folder.str());
  EXPECT_EQ(areas->draw(kCordon, types::AreaKind::kHereFirst).value_or(""), "1");
  EXPECT_FALSE(hand_overs->place.limited.load());
  EXPECT_TRUE(hand_overs->area.read()->empty());
  const auto* first = hand_overs->to_planning.here_first.read();
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(*first, std::vector<types::Polygon>{kCordon});
  EXPECT_EQ(hand_overs->team.areas.read()->own.front().kind, types::AreaKind::kHereFirst);
  settle(*areas);
  areas = make(folder.str());
  EXPECT_EQ(areas->json()["areas"][0]["kind"], "here_first") << "after a restart, too";
  EXPECT_EQ(events.back()["what"], "kept from before");
  EXPECT_TRUE(areas->withdraw("1"));
  EXPECT_EQ(events.back()["area_kind"], "here_first");
  EXPECT_TRUE(events.back()["areas"].empty());
  EXPECT_TRUE(hand_overs->to_planning.here_first.read()->empty());
}

TEST_F(AreaControlTest, AnAreaStaysInTheBuildingWhenTheMapIsCorrected) {
  configured.keep_out = {{{9.0, 9.0}, {10.0, 9.0}, {10.0, 10.0}}};
  const auto areas = make(folder.str());
  std::vector<types::KeyframePose> keyframes{{types::stamp_from_seconds(1.0), {0.0, 0.0, 0.0}},
                                             {types::stamp_from_seconds(2.0), {60.0, 0.0, 0.0}}};
  areas->note_map(keyframes);
  const types::Polygon stairs{{58.0, 1.0}, {61.0, 1.0}, {61.0, 3.0}, {58.0, 3.0}};
  ASSERT_TRUE(areas->draw(kCordon));
  ASSERT_TRUE(areas->draw(stairs));
  keyframes.push_back({types::stamp_from_seconds(3.0), {61.0, 0.0, 0.0}});
  areas->note_map(keyframes);
  EXPECT_EQ(areas->in_force().keep_out[2], stairs) << "nothing was corrected";
  keyframes[1].T_map_base = {59.8, 0.7, 0.0};  // a loop closes
  areas->note_map(keyframes);
  for (auto* reader : {&hand_overs->area, &hand_overs->to_planning.area}) {
    const types::AreaLimits* limits = reader->read();
    ASSERT_NE(limits, nullptr);
    ASSERT_EQ(limits->keep_out.size(), 3U);
    EXPECT_EQ(limits->keep_out[0], configured.keep_out[0]) << "measured from the map's origin";
    EXPECT_EQ(limits->keep_out[1], kCordon) << "beside a keyframe that did not move";
    for (std::size_t i = 0; i < stairs.size(); ++i)
      EXPECT_LT((limits->keep_out[2][i] - stairs[i] - types::Vector2(-0.2, 0.7)).norm(), 1e-9);
  }
  EXPECT_EQ(events.back()["what"], "moved with the map");
  settle(*areas);
  const auto again = make(folder.str());
  EXPECT_EQ(again->in_force().keep_out[2], areas->in_force().keep_out[2]) << "a restart finds it there";
}

TEST_F(AreaControlTest, AnAreaOfBeforeStaysWhenTheRobotIsFoundInTheMapThatGoesOn) {
  const auto areas = make(folder.str());
  ASSERT_TRUE(areas->draw(kCordon));
  std::vector<types::KeyframePose> keyframes{{types::stamp_from_seconds(1.0), {0.0, 0.0, 0.0}}};
  areas->note_map(keyframes);
  hand_overs->place.standing.store(types::PlaceStanding::kUnknown);
  areas->note({});
  keyframes[0].T_map_base = {40.0, 7.0, 1.0};
  areas->note_map(keyframes);
  hand_overs->place.standing.store(types::PlaceStanding::kKnown);
  areas->note_map(keyframes);
  EXPECT_EQ(areas->in_force().keep_out.front(), kCordon);
  keyframes[0].T_map_base = {41.0, 7.0, 1.0};
  areas->note_map(keyframes);
  EXPECT_NE(areas->in_force().keep_out.front(), kCordon) << "a correction again";
}

TEST_F(AreaControlTest, ARestartFindsThem) {
  auto areas = make(folder.str());
  EXPECT_TRUE(areas->draw(kCordon).has_value());
  settle(*areas);
  EXPECT_EQ(areas->json()["kept"], true);
  areas = make(folder.str());
  EXPECT_EQ(areas->in_force().keep_out.size(), 1U);
  EXPECT_EQ(hand_overs->area.read()->keep_out.size(), 1U) << "before the base's thread starts";
  EXPECT_TRUE(areas->withdraw("1").has_value());
  settle(*areas);
  EXPECT_TRUE(make(folder.str())->in_force().empty());
}

TEST_F(AreaControlTest, AFileThatCannotBeReadHoldsMissions) {
  (void)folder.write("areas.json", "{\"version\": 1, \"ar");
  const auto areas = make(folder.str());
  EXPECT_THAT(areas->obstacle(), HasSubstr("areas.json"));
  EXPECT_THAT(areas->draw(kCordon).error().message, HasSubstr("cannot be read"));
  EXPECT_EQ(testing::read_all(folder.file("areas.json")), "{\"version\": 1, \"ar") << "left to people";
}

TEST_F(AreaControlTest, WhatIsNotKeptIsInForceAndSaidSo) {
  const auto areas = make(folder.file("missing/folder"));
  EXPECT_TRUE(areas->draw(kCordon).has_value());
  settle(*areas);
  EXPECT_THAT(areas->trouble(), HasSubstr("NOT kept"));
  EXPECT_EQ(areas->in_force().keep_out.size(), 1U);
  EXPECT_EQ(make("")->json()["kept"], false) << "no folder";
}

TEST_F(AreaControlTest, TheTeamsAreasAreInForceHere) {
  const auto areas = make("");
  areas->note({{{{2, 0, 5}, kCordon}}, {}, {}});
  EXPECT_EQ(hand_overs->area.read()->keep_out, std::vector<types::Polygon>{kCordon});
  EXPECT_EQ(events.size(), 1U);
  areas->note({{}, {{2, 0, 5}}, {}});
  EXPECT_TRUE(hand_overs->area.read()->empty());
}

}  // namespace
}  // namespace topo::daemon

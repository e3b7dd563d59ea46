// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/codecs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>

#include "core/slam/keyframe_codec.hpp"
#include "core/team/exchange/wire.hpp"
#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Cut anywhere, or with a byte too many, it is an error that says something.
template <class Decode>
void expect_only_whole(const std::vector<std::byte>& bytes, Decode decode) {
  EXPECT_TRUE(decode(bytes));
  auto longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(decode(longer));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(
        decode(std::vector<std::byte>(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))))
        << size;
}

slam::FoundRelation between(const slam::KeyframeId& id, const slam::KeyframeId& from,
                            const slam::KeyframeId& to) {
  slam::FoundRelation found = testing::odometry({1, 1, 1});
  found.id = id;
  found.key = {from, to};
  found.relation.robust = true;
  return found;
}

TEST(RelationCodec, GivesTheBitsBack) {
  const slam::KeyframeId own{1, 500, 9}, earlier{1, 3, 9}, mates{7, 70'000, 4'000'000'000U};
  for (const auto& found : {between(own, earlier, own), between(own, own, earlier), between(own, mates, own),
                            between(own, mates, {7, 2, 4'000'000'000U}), between(own, own, mates)}) {
    const auto read = decode_relation(found.id, encode_relation(found));
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->key, found.key);
    EXPECT_EQ(read->id, found.id);
    EXPECT_EQ(read->relation.robust, found.relation.robust);
    EXPECT_EQ(read->relation.T_from_to, found.relation.T_from_to);
    EXPECT_EQ(read->relation.information, found.relation.information);
  }
}

TEST(RelationCodec, OfTheRobotsOwnIsShort) {
  EXPECT_LE(encode_relation(testing::odometry({1, 5'600, 1})).size(), 80U);
}

TEST(RelationCodec, OnlyWholeOnesAreRead) {
  const slam::FoundRelation found = between({1, 1, 1}, {2, 5, 1}, {3, 6, 1});
  expect_only_whole(encode_relation(found),
                    [&](const auto& bytes) { return decode_relation(found.id, bytes).has_value(); });
}

TEST(RelationCodec, WhatIsNoRelationIsRefused) {
  slam::FoundRelation found = testing::odometry({1, 1, 1});
  found.relation.T_from_to.x_m = kNan;
  EXPECT_FALSE(decode_relation(found.id, encode_relation(found)));
  found = testing::odometry({1, 1, 1});
  found.key.second = found.key.first;
  EXPECT_FALSE(decode_relation(found.id, encode_relation(found)));
}

TEST(LogCodec, GivesEveryEntryBack) {
  const std::vector<LogBody> bodies{Visited{{1.5, -2.25}, false},
                                    LookedInto{{0.1, 0.2}, true},
                                    KeepOut{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}},
                                    Order{OrderKind::kEstop},
                                    Order{OrderKind::kHome, std::uint16_t{65'535}},
                                    Acknowledgement{{4, 17, 3}},
                                    Acknowledgement{{4, 17, 3}, "the e-stop is latched"},
                                    Withdrawn{{2, 5, 77}},
                                    HereFirst{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}},
                                    AreaMoved{{2, 5, 77}, {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}}};
  for (const LogBody& body : bodies) {
    const auto read = decode_log(encode_log(body));
    ASSERT_TRUE(read.has_value()) << body.index();
    EXPECT_EQ(*read, body) << body.index();
    expect_only_whole(encode_log(body), [](const auto& bytes) { return decode_log(bytes).has_value(); });
  }
}

TEST(LogCodec, TheLargestAreaFitsInADatagram) {
  const KeepOut area{types::Polygon(kCornersMax, types::Vector2(1.0, 2.0))};
  EXPECT_LE(encode_log(area).size(), kSmallItemBytesMax);
  EXPECT_TRUE(decode_log(encode_log(area)));
  EXPECT_LE(encode_log(AreaMoved{{UINT16_MAX, kNumbersMax - 1, UINT32_MAX}, area.corners_map}).size(),
            kSmallItemBytesMax);
}

TEST(LogCodec, WhatIsNoEntryIsRefused) {
  EXPECT_FALSE(decode_log(encode_log(Visited{{kNan, 0.0}, false})));
  EXPECT_FALSE(decode_log(encode_log(Visited{{2e5, 0.0}, false})));
  EXPECT_FALSE(decode_log(encode_log(KeepOut{{{0.0, 0.0}, {1.0, 0.0}}})));
  EXPECT_FALSE(decode_log(encode_log(KeepOut{types::Polygon(kCornersMax + 1, types::Vector2(0.0, 0.0))})));
  EXPECT_FALSE(decode_log(encode_log(HereFirst{{{0.0, 0.0}, {1.0, 0.0}}})));
  EXPECT_FALSE(decode_log(encode_log(AreaMoved{{2, 5, 77}, {{0.0, 0.0}, {1.0, 0.0}}})));
  EXPECT_FALSE(decode_log(testing::bytes_of({9, 0})));
  EXPECT_FALSE(decode_log(testing::bytes_of({10, 0})));
  EXPECT_FALSE(decode_log(testing::bytes_of({3, 200}))) << "no such order";
  EXPECT_FALSE(decode_log(testing::bytes_of({7, 200, 1, 0}))) << "no such order";
  EXPECT_TRUE(decode_log(testing::bytes_of({7, 2, 1, 0})));
  const EntryId order{4, 17, 3};
  EXPECT_TRUE(decode_log(encode_log(Acknowledgement{order, std::string(kRefusalBytesMax, 'x')})));
  EXPECT_FALSE(decode_log(encode_log(Acknowledgement{order, std::string(kRefusalBytesMax + 1, 'x')})));
  EXPECT_FALSE(decode_log(encode_log(Acknowledgement{order, "a line\nand another"})));
}

TEST(LogCodec, OrdersHaveNames) {
  EXPECT_EQ(to_text(OrderKind::kStop), "stop");
  EXPECT_EQ(to_text(OrderKind::kEstop), "estop");
  EXPECT_EQ(to_text(OrderKind::kStart), "start");
  EXPECT_EQ(to_text(OrderKind::kPause), "pause");
  EXPECT_EQ(to_text(OrderKind::kResume), "resume");
  EXPECT_EQ(to_text(OrderKind::kHome), "home");
}

StatusMessage full_status() {
  StatusMessage status;
  status.robot = 3;
  status.sequence = 70'000;
  status.T_map_base = {1.0 / 3.0, -2.0, 0.5};
  status.start = {0.1, 0.2};
  status.home = types::Vector2(4.0, 5.0);
  status.duty = Duty::kAble;
  status.claim = Bid{{1.0 / 7.0, 2.0}, 10.0 / 3.0, false};
  status.in_common_frame = true;
  status.anchors = {{4'000'000'000U, 0, {1.0 / 3.0, 2.0, 3.0}}, {17, 300, {-5.0, 1e-9, -1.0}}};
  for (int i = 0; i < 30; ++i) status.bids.push_back({{i * 1.25, -i * 0.5}, 3.0 * i - 8.0, i % 2 == 0});
  for (int i = 0; i < 20; ++i) status.way_map.emplace_back(0.3 * i, 0.02 * i);
  return status;
}

TEST(StatusCodec, ClaimAndPoseAreExactTheRestToACentimetre) {
  const StatusMessage status = full_status();
  const auto read = decode_status(3, encode_status(status, kBodyBytesMax));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->robot, status.robot);
  EXPECT_EQ(read->sequence, status.sequence);
  EXPECT_EQ(read->T_map_base, status.T_map_base);
  EXPECT_EQ(read->start, status.start);
  EXPECT_EQ(read->home, status.home);
  EXPECT_EQ(read->duty, status.duty);
  EXPECT_TRUE(read->in_common_frame);
  ASSERT_EQ(read->anchors.size(), status.anchors.size());
  for (std::size_t i = 0; i < status.anchors.size(); ++i) {
    EXPECT_EQ(read->anchors[i].run, status.anchors[i].run);
    EXPECT_EQ(read->anchors[i].sequence, status.anchors[i].sequence);
    EXPECT_EQ(read->anchors[i].T_map_base, status.anchors[i].T_map_base);
  }
  EXPECT_EQ(read->claim->p_map, status.claim->p_map);
  EXPECT_EQ(read->claim->cost_m, status.claim->cost_m);
  EXPECT_EQ(read->claim->essential, false);
  ASSERT_EQ(read->bids.size(), status.bids.size());
  for (std::size_t i = 0; i < status.bids.size(); ++i) {
    EXPECT_LT((read->bids[i].p_map - status.bids[i].p_map).norm(), 0.0075);
    EXPECT_NEAR(read->bids[i].cost_m, status.bids[i].cost_m, 0.0051);
    EXPECT_EQ(read->bids[i].essential, status.bids[i].essential);
  }
  ASSERT_EQ(read->way_map.size(), status.way_map.size());
  EXPECT_LT((read->way_map.back() - status.way_map.back()).norm(), 0.0075);
}

TEST(StatusCodec, BidsComeInTheStepsThatTheirSenderDecidesWith) {
  StatusMessage status = full_status();
  status.bids.clear();
  for (int i = 0; i < 20; ++i) status.bids.push_back({{i * 1.0 / 3.0, -i / 7.0}, i / 9.0 - 1.0, i % 2 == 0});
  const auto read = decode_status(3, encode_status(status, kBodyBytesMax));
  ASSERT_TRUE(read.has_value());
  ASSERT_EQ(read->bids.size(), status.bids.size());
  for (std::size_t i = 0; i < status.bids.size(); ++i) {
    const Bid own = in_steps(status.bids[i]);
    EXPECT_EQ(read->bids[i].p_map, own.p_map);
    EXPECT_EQ(read->bids[i].cost_m, own.cost_m);
  }
}

TEST(StatusCodec, AsManyBidsAsThereIsRoomFor) {
  StatusMessage status = full_status();
  for (int i = 0; i < 1'000; ++i) status.bids.push_back({{i * 97.25, -i * 31.5}, 300.0 * i, true});
  for (const std::size_t room : {std::size_t{120}, std::size_t{400}, kBodyBytesMax}) {
    const auto bytes = encode_status(status, room);
    EXPECT_LE(bytes.size(), room);
    const auto read = decode_status(3, bytes);
    ASSERT_TRUE(read.has_value()) << room;
    EXPECT_LT(read->bids.size(), status.bids.size());
    EXPECT_TRUE(room < kBodyBytesMax || read->way_map.size() == status.way_map.size());
  }
}

TEST(StatusCodec, OnlyWholeOnesAreRead) {
  expect_only_whole(encode_status(full_status(), 400),
                    [](const auto& bytes) { return decode_status(3, bytes).has_value(); });
}

TEST(StatusCodec, WhatIsOutOfReachIsRefused) {
  StatusMessage status = full_status();
  status.T_map_base.x_m = kNan;
  EXPECT_FALSE(decode_status(3, encode_status(status, kBodyBytesMax)));
  status = full_status();
  status.claim->cost_m = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(decode_status(3, encode_status(status, kBodyBytesMax)));
}

TEST(CheckItem, AnItemIsWhatItsKeySays) {
  const slam::KeyframeId id{1, 2, 3};
  const auto bytes = slam::encode_keyframe(testing::sample_keyframe(id, 50));
  const StreamKey frames{ItemKind::kKeyframe, {1, 3}};
  EXPECT_TRUE(check_item({frames, 2}, bytes));
  EXPECT_FALSE(check_item({frames, 1}, bytes)) << "another number";
  EXPECT_FALSE(check_item({{ItemKind::kKeyframe, {2, 3}}, 2}, bytes)) << "another robot";
  EXPECT_FALSE(check_item({{ItemKind::kLog, {1, 3}}, 2}, bytes));
  EXPECT_FALSE(check_item({{ItemKind::kRelation, {1, 3}}, 2}, bytes));
  EXPECT_TRUE(check_item({{ItemKind::kLog, {1, 3}}, 2}, encode_log(Visited{})));
}

}  // namespace
}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>

#include "core/team/exchange/wire.hpp"
#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

using testing::at;
using testing::kTeam;
using testing::params_for;
using testing::Robot;
using testing::send;
using testing::talk;

bool are_equal(const Robot& a, const Robot& b) {
  return a.exchange.items().hash() == b.exchange.items().hash();
}

std::size_t keyframes(const Robot& robot) { return keyframes_of(robot.exchange.items()).size(); }

TEST(Exchange, WhatOneHasTheOtherGetsAsItIs) {
  Robot a(1), b(2);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(a.make());
  talk(a, b, 0.0, 8.0);
  EXPECT_TRUE(are_equal(a, b));
  const ExchangeNews news = b.exchange.take_news(at(8.0));
  ASSERT_EQ(news.keyframes.size(), 5U);
  EXPECT_EQ(news.relations.size(), 4U);
  slam::Keyframe sample = testing::sample_keyframe({1, 0, 1});
  slam::KeyframeSet theirs, ours;
  theirs.insert(news.keyframes.front());
  ours.insert(std::make_shared<const slam::Keyframe>(sample));
  EXPECT_TRUE(theirs == ours);
  EXPECT_TRUE(b.exchange.take_news(at(8.1)).keyframes.empty()) << "news come once";
  EXPECT_EQ(relations_of(b.exchange.items()).size(), 4U);
}

TEST(Exchange, WhatIsLostIsSentAgain) {
  Robot a(1), b(2);
  ASSERT_TRUE(a.make());
  talk(a, b, 0.0, 4.0);
  ASSERT_TRUE(a.make());
  for (double t = 4.0; t < 6.0; t += 0.05) {
    (void)a.exchange.datagrams(at(t));  // lost
    send(b, a, at(t));
  }
  EXPECT_EQ(keyframes(b), 1U);
  talk(a, b, 6.0, 12.0);
  EXPECT_TRUE(are_equal(a, b));
}

TEST(Exchange, WhatTheReceiverHasIsNotSent) {
  Robot a(1), b(2);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(a.make());
  talk(a, b, 0.0, 8.0);
  const auto piece = static_cast<std::size_t>(MessageKind::kPiece);
  const std::uint64_t sent = a.exchange.counters().sent_bytes_of.at(piece);
  talk(a, b, 8.0, 20.0);
  EXPECT_EQ(a.exchange.counters().sent_bytes_of.at(piece), sent);
  EXPECT_EQ(b.exchange.counters().repeated, 0U) << "nor was any piece sent twice";
}

TEST(Exchange, WhatIsJustMadeGoesBeforeAnybodyAsks) {
  Robot a(1), b(2);
  talk(a, b, 0.0, 4.0);
  ASSERT_TRUE(a.make());
  for (double t = 4.0; t < 5.0; t += 0.05) send(a, b, at(t));  // nothing comes back
  EXPECT_EQ(keyframes(b), 1U);
  Robot c(3);
  ASSERT_TRUE(c.make());
  for (double t = 0.0; t < 5.0; t += 0.05) (void)c.exchange.datagrams(at(t));
  EXPECT_EQ(c.exchange.counters().sent_bytes_of.at(static_cast<std::size_t>(MessageKind::kPiece)), 0U)
      << "nobody hears it";
}

TEST(Exchange, NewsAreBounded) {
  Robot a(1), b(2);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(a.make(50));
  talk(a, b, 0.0, 8.0);
  std::vector<std::size_t> counts;
  for (int i = 0; i < 4; ++i) counts.push_back(b.exchange.take_news(at(8.0 + i)).keyframes.size());
  EXPECT_EQ(counts, (std::vector<std::size_t>{8, 8, 4, 0}));
}

TEST(Exchange, AThirdRobotGetsItByWayOfASecond) {
  Robot a(1), b(2), c(3);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(a.make());
  talk(a, b, 0.0, 8.0);
  talk(b, c, 100.0, 108.0);
  EXPECT_TRUE(are_equal(a, c));
}

TEST(Exchange, NoDatagramIsTooLongAndTheBudgetHolds) {
  Robot a(1), b(2);
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(a.make());
  talk(a, b, 0.0, 1.0);
  const std::uint64_t before = a.exchange.counters().sent_bytes;
  for (double t = 1.0; t < 3.0; t += 0.05) {
    for (const Datagram& datagram : a.exchange.datagrams(at(t))) {
      EXPECT_LE(datagram.size(), kDatagramBytesMax);
      b.exchange.take(datagram, at(t));
    }
    send(b, a, at(t));
  }
  const double rate_bytes_per_s = static_cast<double>(a.exchange.counters().sent_bytes - before) / 2.0;
  EXPECT_LT(rate_bytes_per_s, 210'000.0);
  EXPECT_GT(rate_bytes_per_s, 150'000.0);
}

TEST(Exchange, ContactAfterAnHourIsNoBurst) {
  Robot a(1), b(2);
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(a.make());
  (void)a.exchange.datagrams(at(0.0));
  std::size_t most = 0;
  for (double t = 3'600.0; t < 3'605.0; t += 0.05) {
    std::size_t bytes = 0;
    for (const Datagram& datagram : a.exchange.datagrams(at(t))) {
      bytes += datagram.size();
      b.exchange.take(datagram, at(t));
    }
    most = std::max(most, bytes);
    send(b, a, at(t));
  }
  EXPECT_LE(most, 22'000U) << "a tenth of a second at the rate of catching up";
}

TEST(Exchange, TimeApartTakesNoMemoryAndSendsNoItems) {
  Robot a(1), b(2);
  ASSERT_TRUE(a.make());
  talk(a, b, 0.0, 5.0);
  const std::uint64_t before = a.exchange.counters().sent_bytes;
  for (double t = 10.0; t < 3'600.0; t += 0.2) (void)a.exchange.datagrams(at(t));
  EXPECT_LT(static_cast<double>(a.exchange.counters().sent_bytes - before) / 3'590.0, 150.0);
  EXPECT_EQ(a.exchange.assembly_bytes(), 0U);
  EXPECT_TRUE(a.exchange.peers(at(3'600.0)).empty()) << "the mate is forgotten, its items are not";
  EXPECT_EQ(a.exchange.items().size(), b.exchange.items().size());
}

TEST(Exchange, OwnItemsComeInTheirTurn) {
  Robot a(1);
  ASSERT_TRUE(a.make());
  EXPECT_TRUE(a.exchange.add_keyframe(testing::sample_keyframe({1, 0, 1})).has_value())
      << "once more is no fault";
  EXPECT_FALSE(a.exchange.add_keyframe(testing::sample_keyframe({1, 2, 1})).has_value());
  EXPECT_FALSE(a.exchange.add_keyframe(testing::sample_keyframe({2, 0, 1})).has_value());
  EXPECT_FALSE(a.exchange.add_keyframe(testing::sample_keyframe({1, 1, 1}, 60'000)).has_value());
  slam::FoundRelation found = testing::odometry({1, 1, 1});
  found.key.second = found.key.first;
  EXPECT_FALSE(a.exchange.add_relation(found).has_value());
  EXPECT_FALSE(a.exchange.add_entry(KeepOut{{{0.0, 0.0}}}).has_value());
}

TEST(Exchange, ARestartGoesOnWithWhatTheJournalHeld) {
  Robot a(1), again(1, 2), b(2);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(a.make());
  ASSERT_TRUE(a.exchange.add_entry(Visited{{1.0, 2.0}, false}).has_value());
  for (std::uint32_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(again.exchange.restore_keyframe(testing::sample_keyframe({1, i, 1})).has_value());
    ASSERT_TRUE(i == 0 || again.exchange.restore_relation(testing::odometry({1, i, 1})).has_value());
  }
  for (const LogEntry& entry : log_of(a.exchange.items()))
    ASSERT_TRUE(again.exchange.restore_entry(entry).has_value());
  EXPECT_TRUE(are_equal(a, again));
  EXPECT_TRUE(again.exchange.take_news(at(0.0)).empty()) << "what is restored is no news";
  ASSERT_TRUE(again.make());
  talk(again, b, 0.0, 8.0);
  EXPECT_TRUE(are_equal(again, b));
  EXPECT_EQ(keyframes(b), 4U);
}

TEST(Exchange, WhatAnEarlierRunMadeComesBackFromMates) {
  Robot a(1), b(2), again(1, 2);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(a.make());
  talk(a, b, 0.0, 8.0);
  talk(again, b, 20.0, 28.0);
  EXPECT_EQ(keyframes(again), 3U);
}

TEST(Exchange, StatusesAreNewestWinsAndCarryTheLog) {
  Robot a(1), b(2);
  StatusMessage status;
  status.visited = {{1.0, 2.0}};
  status.looked = {{3.0, 4.0}};
  status.duty = Duty::kAble;
  for (double t = 0.0; t < 3.0; t += 0.05) {
    status.T_map_base.x_m = t;
    a.exchange.say(status);
    talk(a, b, t, t + 0.01);
  }
  const ExchangeNews news = b.exchange.take_news(at(3.0));
  ASSERT_EQ(news.statuses.size(), 1U) << "the newest alone";
  const HeardStatus& heard = news.statuses.front();
  EXPECT_EQ(heard.message.robot, 1U);
  EXPECT_EQ(heard.run, 1U);
  EXPECT_GT(heard.message.T_map_base.x_m, 2.4);
  EXPECT_EQ(heard.message.visited, status.visited);
  EXPECT_EQ(heard.message.looked, status.looked);
  EXPECT_LE(at(3.0) - heard.heard, types::from_seconds(0.5));
  EXPECT_TRUE(b.exchange.take_news(at(3.1)).statuses.empty());
}

TEST(Exchange, AReplayedStatusIsDroppedAndCounted) {
  Robot a(1), b(2);
  a.exchange.say({});
  const auto first = a.exchange.datagrams(at(0.0));
  for (int i = 0; i < 2; ++i) {
    for (const Datagram& datagram : first) b.exchange.take(datagram, at(0.1));
  }
  EXPECT_EQ(b.exchange.counters().replayed, first.size());
  EXPECT_EQ(b.exchange.take_news(at(0.2)).statuses.size(), 1U);
  for (const Datagram& datagram : first) b.exchange.take(datagram, at(100.0));
  EXPECT_TRUE(b.exchange.take_news(at(100.0)).statuses.empty());
}

TEST(Exchange, WhatIsNotOfTheTeamIsCountedByItsKind) {
  Robot a(1), other({kTeam + 1, 2, 1}, params_for(2));
  for (const Datagram& datagram : other.exchange.datagrams(at(0.0))) a.exchange.take(datagram, at(0.0));
  EXPECT_EQ(a.exchange.counters().other_team, 1U);
  Datagram later = other.exchange.datagrams(at(1.0)).front();
  later[1] = std::byte{kWireVersion + 1};
  a.exchange.take(later, at(1.0));
  EXPECT_EQ(a.exchange.counters().other_version, 1U);
  a.exchange.take({}, at(1.0));
  a.exchange.take(std::vector<std::byte>(kDatagramBytesMax + 1), at(1.0));
  EXPECT_EQ(a.exchange.counters().malformed, 2U);
  for (const Datagram& datagram : a.exchange.datagrams(at(1.0))) a.exchange.take(datagram, at(1.0));
  EXPECT_EQ(a.exchange.counters().own_echo, 1U);
  EXPECT_TRUE(a.exchange.peers(at(1.0)).empty());
  EXPECT_TRUE(a.exchange.take_news(at(1.0)).empty());
}

TEST(Exchange, WhoSaysAnothersNumberIsNotHeard) {
  Robot a(1), b(2);
  EXPECT_TRUE(b.make());
  for (double t = 0.0; t < 3.0; t += 0.05) {
    for (const Datagram& datagram : b.exchange.datagrams(at(t))) a.exchange.take(datagram, at(t), 3);
    send(a, b, at(t));
  }
  EXPECT_GT(a.exchange.counters().false_number, 0U);
  EXPECT_TRUE(a.exchange.peers(at(3.0)).empty());
  EXPECT_EQ(a.exchange.items().size(), 0U);
  for (double t = 3.0; t < 6.0; t += 0.05) {
    for (const Datagram& datagram : b.exchange.datagrams(at(t))) a.exchange.take(datagram, at(t), 2);
    send(a, b, at(t));
  }
  EXPECT_EQ(a.exchange.items().size(), 1U) << "the carrier knows it by this number";
}

TEST(Exchange, BytesThatAreNoItemStayOutside) {
  Robot a(1);
  DatagramWriter writer({kTeam, {2, 1}, 0});
  types::ByteWriter body;
  write_key(body, {{ItemKind::kLog, {2, 1}}, 0});
  body.append(testing::bytes_of({99}));
  writer.add(MessageKind::kLog, body.bytes());
  types::ByteWriter ours;
  write_key(ours, {{ItemKind::kLog, {1, 1}}, 0});
  ours.append(testing::bytes_of({3, 1}));
  writer.add(MessageKind::kLog, ours.bytes());
  a.exchange.take(writer.take(), at(0.0));
  EXPECT_EQ(a.exchange.counters().malformed_item, 1U);
  EXPECT_EQ(a.exchange.counters().claims_ours, 1U) << "an order that this run never gave";
  EXPECT_EQ(a.exchange.items().size(), 0U);
}

TEST(Exchange, MatesCannotFillTheStoreBeyondItsCap) {
  ExchangeParams params = params_for(2);
  params.caps.store_bytes = 20'000;
  params.caps.streams = 4;
  Robot a(1), b({kTeam, 2, 1}, params);
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(a.make());
  talk(a, b, 0.0, 20.0);
  EXPECT_LE(b.exchange.items().bytes(), 20'000U);
  EXPECT_GT(b.exchange.counters().too_many, 0U);
}

TEST(Exchange, AMateIsSeenAsItIs) {
  Robot a(1), b(2);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(a.make());
  talk(a, b, 0.0, 0.1);
  const auto early = a.exchange.peers(at(0.1));
  ASSERT_EQ(early.size(), 1U);
  EXPECT_EQ(early[0].robot, 2U);
  EXPECT_EQ(early[0].it_lacks_items, 5U);
  EXPECT_GT(early[0].it_lacks_bytes, 3'000U);
  EXPECT_FALSE(early[0].same_sets);
  talk(a, b, 0.1, 12.0);
  const PeerView late = a.exchange.peers(at(12.0)).front();
  EXPECT_TRUE(late.same_sets && late.alive && late.hears_us);
  EXPECT_EQ(late.it_lacks_items + late.lacks_here_items, 0U);
  ASSERT_TRUE(late.round_trip_s);
  EXPECT_LT(*late.round_trip_s, 0.06);
  EXPECT_FALSE(a.exchange.peers(at(40.0)).front().alive);
}

TEST(Exchange, ARestartedMateIsHeardAtOnce) {
  for (const std::uint32_t next_run : {3U, 9U}) {  // runs are drawn: the next may be the lower one
    Robot a(1), before(2, 5), after(2, next_run);
    const auto says = [&](Robot& mate, double charge, double from_s) {
      StatusMessage status;
      status.T_map_base.x_m = charge;
      mate.exchange.say(status);
      talk(a, mate, from_s, from_s + 2.0);
      std::vector<HeardStatus> heard = a.exchange.take_news(at(from_s + 2.0)).statuses;
      return heard.size() == 1 ? std::pair(heard[0].run, heard[0].message.T_map_base.x_m)
                               : std::pair(0U, 0.0);
    };
    EXPECT_EQ(says(before, 1.0, 0.0), std::pair(5U, 1.0));
    EXPECT_EQ(says(after, 2.0, 2.5), std::pair(next_run, 2.0));
    const auto peers = a.exchange.peers(at(4.5));
    ASSERT_EQ(peers.size(), 1U) << "the run before is over";
    EXPECT_EQ(peers.front().run, next_run);
  }
}

TEST(Exchange, TwoWithOneIdAreSeenByBothAndByOthers) {
  Robot one(1, 5), two(1, 6), mate(2);
  std::array<std::vector<DuplicateId>, 3> found;
  const std::array<Robot*, 3> all{&one, &two, &mate};
  for (double t = 0.0; t < 4.0; t += 0.05) {
    for (Robot* from : all) {
      for (const Datagram& datagram : from->exchange.datagrams(at(t))) {
        for (Robot* to : all) to->exchange.take(datagram, at(t));
      }
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      const ExchangeNews news = all.at(i)->exchange.take_news(at(t));
      found.at(i).insert(found.at(i).end(), news.duplicates.begin(), news.duplicates.end());
    }
  }
  for (const auto& each : found) {
    ASSERT_FALSE(each.empty());
    EXPECT_LE(each.size(), 2U) << "not in every step";
    EXPECT_EQ(each.front().robot, 1U);
  }
  EXPECT_TRUE(found[0].front().own && found[1].front().own);
  EXPECT_FALSE(found[2].front().own);
  EXPECT_GT(one.exchange.counters().duplicate_ids, 0U);
  EXPECT_GT(mate.exchange.counters().duplicate_ids, 0U) << "what neither can be told from is not taken";
}

TEST(Exchange, TheSameRunWithALaterCounterIsAnother) {
  Robot one(1), two(1);
  for (double t = 0.0; t < 5.0; t += 0.05) (void)two.exchange.datagrams(at(t));
  for (const Datagram& datagram : one.exchange.datagrams(at(5.0))) one.exchange.take(datagram, at(5.0));
  EXPECT_TRUE(one.exchange.take_news(at(5.0)).duplicates.empty()) << "its own echo";
  for (double t = 5.0; t < 6.0; t += 0.05) {
    for (const Datagram& datagram : two.exchange.datagrams(at(t))) one.exchange.take(datagram, at(t));
  }
  const ExchangeNews news = one.exchange.take_news(at(6.0));
  ASSERT_EQ(news.duplicates.size(), 1U);
  EXPECT_TRUE(news.duplicates[0].own);
}

TEST(Exchange, ACopyGoesItsOwnWay) {
  Robot a(1);
  ASSERT_TRUE(a.make());
  Robot copy = a;
  ASSERT_TRUE(copy.make());
  EXPECT_EQ(keyframes(a), 1U);
  EXPECT_EQ(keyframes(copy), 2U);
}

}  // namespace
}  // namespace topo::team

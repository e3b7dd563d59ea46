// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

// Orders through the whole exchange: they are repeated, pass through a robot in between, and are
// acknowledged.
namespace topo::team {
namespace {

using testing::at;
using testing::Robot;
using testing::send;
using testing::talk;

TEST(OrderFlow, AnOrderArrivesInTheNextDatagram) {
  Robot a(1), b(2);
  talk(a, b, 0.0, 1.0);
  const EntryId id = a.exchange.order({OrderKind::kEstop}, at(1.0));
  send(a, b, at(1.0));
  const ExchangeNews news = b.exchange.take_news(at(1.0));
  ASSERT_EQ(news.orders.size(), 1U);
  EXPECT_EQ(news.orders[0].id, id);
  EXPECT_EQ(news.orders[0].order.kind, OrderKind::kEstop);
  ASSERT_TRUE(news.orders[0].age);
  EXPECT_LT(*news.orders[0].age, std::chrono::milliseconds(10));
  EXPECT_TRUE(a.exchange.acknowledged_by(id).empty()) << "nobody has carried it out";
}

TEST(OrderFlow, ItIsRepeatedUntilItIsAcknowledged) {
  Robot a(1), b(2);
  talk(a, b, 0.0, 1.0);
  const EntryId id = a.exchange.order({OrderKind::kEstop}, at(1.0));
  const auto sent = [&] {
    return a.exchange.counters().sent_bytes_of.at(static_cast<std::size_t>(MessageKind::kOrder));
  };
  for (double t = 1.0; t < 2.0; t += 0.05) (void)a.exchange.datagrams(at(t));  // all lost
  const std::uint64_t repeated = sent();
  send(a, b, at(2.05));
  ASSERT_EQ(b.exchange.take_news(at(2.05)).orders.size(), 1U);
  b.exchange.acknowledge(id, at(2.06));
  send(b, a, at(2.1));
  EXPECT_EQ(a.exchange.acknowledged_by(id), (std::vector<std::uint16_t>{2}));
  const std::uint64_t at_end = sent();
  EXPECT_GT(at_end, repeated / 2);
  talk(a, b, 2.15, 6.0);
  EXPECT_EQ(sent(), at_end) << "it is not repeated any longer";
  EXPECT_TRUE(b.exchange.take_news(at(6.0)).orders.empty());
}

TEST(OrderFlow, ALostAcknowledgementIsGivenAgain) {
  Robot a(1), b(2);
  talk(a, b, 0.0, 1.0);
  const EntryId id = a.exchange.order({OrderKind::kStop}, at(1.0));
  send(a, b, at(1.0));
  b.exchange.acknowledge(id, at(1.0));
  (void)b.exchange.datagrams(at(1.0));  // lost
  send(a, b, at(1.1));
  send(b, a, at(1.1));
  EXPECT_EQ(a.exchange.acknowledged_by(id), (std::vector<std::uint16_t>{2}));
}

TEST(OrderFlow, ItPassesThroughARobotInBetween) {
  Robot a(1), b(2), c(3);
  const auto round = [&](double t) {
    send(a, b, at(t));
    send(c, b, at(t));
    for (const Datagram& datagram : b.exchange.datagrams(at(t))) {
      a.exchange.take(datagram, at(t));
      c.exchange.take(datagram, at(t));
    }
  };
  for (double t = 0.0; t < 1.0; t += 0.05) round(t);
  const EntryId id = a.exchange.order({OrderKind::kEstop}, at(1.0));
  for (double t = 1.0; t < 1.3; t += 0.05) {
    round(t);
    for (Robot* robot : {&b, &c}) {
      for (const HeardOrder& heard : robot->exchange.take_news(at(t)).orders) {
        EXPECT_TRUE(heard.age) << "it is young";
        robot->exchange.acknowledge(heard.id, at(t));
      }
    }
  }
  EXPECT_EQ(a.exchange.acknowledged_by(id), (std::vector<std::uint16_t>{2, 3}));
}

TEST(OrderFlow, AnOrderToOneReachesThatOneThroughAnother) {
  Robot a(1), b(2), c(3);
  const auto all_hear = [&](double t) {
    for (Robot* from : {&a, &b, &c}) {
      for (const Datagram& datagram : from->exchange.datagrams(at(t)))
        for (Robot* to : {&a, &b, &c})
          if (to != from) to->exchange.take(datagram, at(t));
    }
  };
  for (double t = 0.0; t < 1.0; t += 0.05) all_hear(t);
  const EntryId id = a.exchange.order({OrderKind::kStart, std::uint16_t{3}}, at(1.0));
  // From now on a reaches c by way of b alone.
  const auto through_b = [&](double t) {
    send(a, b, at(t));
    for (const Datagram& datagram : b.exchange.datagrams(at(t)))
      for (Robot* to : {&a, &c}) to->exchange.take(datagram, at(t));
    send(c, b, at(t));
  };
  for (double t = 1.0; t < 1.3; t += 0.05) {
    through_b(t);
    EXPECT_TRUE(b.exchange.take_news(at(t)).orders.empty()) << "it is not for b";
    for (const HeardOrder& heard : c.exchange.take_news(at(t)).orders) {
      ASSERT_TRUE(heard.age) << "it is young";
      EXPECT_EQ(heard.order, (Order{OrderKind::kStart, std::uint16_t{3}}));
      c.exchange.acknowledge(heard.id, at(t), "the e-stop is\nlatched");
    }
  }
  EXPECT_TRUE(a.exchange.acknowledged_by(id).empty());
  EXPECT_EQ(a.exchange.refused_by(id), (std::map<std::uint16_t, std::string>{{3, "the e-stop is?latched"}}));
  const auto sent = [&] {
    return a.exchange.counters().sent_bytes_of.at(static_cast<std::size_t>(MessageKind::kOrder));
  };
  const std::uint64_t at_end = sent();
  for (double t = 1.3; t < 2.0; t += 0.05) through_b(t);
  EXPECT_EQ(sent(), at_end) << "b's word is not awaited";
}

TEST(OrderFlow, AnOldOneComesWithTheLogAndWithoutAnAge) {
  Robot a(1), b(2);
  (void)a.exchange.order({OrderKind::kStop}, at(0.0));
  talk(a, b, 500.0, 504.0);
  const ExchangeNews news = b.exchange.take_news(at(504.0));
  ASSERT_EQ(news.orders.size(), 1U);
  EXPECT_FALSE(news.orders[0].age);
  EXPECT_EQ(news.entries.size(), 1U);
}

TEST(OrderFlow, TheJournalGetsOwnEntriesToo) {
  Robot a(1);
  (void)a.exchange.order({OrderKind::kStop}, at(0.0));
  StatusMessage status;
  status.visited = {{1.0, 1.0}};
  a.exchange.say(status);
  const ExchangeNews news = a.exchange.take_news(at(0.0));
  EXPECT_EQ(news.entries.size(), 2U);
  EXPECT_TRUE(news.orders.empty());
}

}  // namespace
}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/orders.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

using testing::at;

const EntryId kOrder{1, 5, 1}, kEntry{2, 0, 1};

TEST(Orders, AreRepeatedForTheirTime) {
  const PeriodParams periods;
  Orders orders(1);
  EXPECT_TRUE(orders.repeat(kOrder, std::chrono::seconds(10), at(0.0)));
  EXPECT_FALSE(orders.repeat(kOrder, std::chrono::seconds(0), at(1.0)));
  orders.expire(periods, at(periods.order_repeat_s - 10.0));
  EXPECT_TRUE(orders.is_urgent(kOrder));
  orders.expire(periods, at(periods.order_repeat_s - 9.9));
  EXPECT_FALSE(orders.is_urgent(kOrder)) << "its age when it came counts";
}

TEST(Orders, TheOldestGivesWayToTheNinth) {
  Orders orders(1);
  for (std::uint32_t i = 0; i < 9; ++i) orders.repeat({1, i, 1}, {}, at(i));
  EXPECT_FALSE(orders.is_urgent({1, 0, 1}));
  EXPECT_TRUE(orders.is_urgent({1, 8, 1}));
  EXPECT_EQ(orders.urgent().size(), 8U);
}

TEST(Orders, AcknowledgementsAreKeptByRobot) {
  Orders orders(1);
  EXPECT_FALSE(orders.has_acknowledged(2, kOrder));
  orders.note({kOrder}, kEntry);
  orders.note({kOrder}, {3, 7, 1});
  EXPECT_TRUE(orders.has_acknowledged(2, kOrder));
  EXPECT_EQ(orders.acknowledged_by(kOrder), (std::vector<std::uint16_t>{2, 3}));
  EXPECT_TRUE(orders.acknowledged_by({9, 9, 9}).empty());
  orders.note({kOrder, "no"}, {4, 1, 1});
  EXPECT_TRUE(orders.has_acknowledged(4, kOrder)) << "it has said its word";
  EXPECT_EQ(orders.acknowledged_by(kOrder), (std::vector<std::uint16_t>{2, 3}));
  EXPECT_EQ(orders.refused_by(kOrder), (std::map<std::uint16_t, std::string>{{4, "no"}}));
}

TEST(Orders, AnAcknowledgementIsSentOncePerRequest) {
  Orders orders(1);
  orders.send_acknowledgement(2, kOrder);
  EXPECT_TRUE(orders.take_to_send().empty()) << "there is none";
  orders.note({kOrder}, kEntry);
  orders.send_acknowledgement(2, kOrder);
  orders.send_acknowledgement(2, kOrder);
  EXPECT_EQ(orders.take_to_send(), (std::set<EntryId>{kEntry}));
  EXPECT_TRUE(orders.take_to_send().empty());
}

}  // namespace
}  // namespace topo::team

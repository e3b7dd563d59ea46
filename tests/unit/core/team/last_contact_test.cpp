// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/last_contact.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/team/clock.hpp"

namespace topo::team {
namespace {

using types::Vector2;

using testing::at;

TEST(LastContact, whoNeverHeardOfAnybodyMissesNobody) {
  EXPECT_EQ(LastContact(60.0).lost_at(at(5000.0)), std::nullopt);
}

TEST(LastContact, isLostAfterItsTimeWhereItWasLastHad) {
  LastContact contact(60.0);
  contact.heard({1.0, 2.0}, at(0.0));
  contact.heard({3.0, 4.0}, at(10.0));
  EXPECT_EQ(contact.lost_at(at(70.0)), std::nullopt);
  EXPECT_EQ(contact.lost_at(at(70.1)), Vector2(3.0, 4.0));
  contact.heard({5.0, 6.0}, at(80.0));
  EXPECT_EQ(contact.lost_at(at(100.0)), std::nullopt) << "it is back";
}

TEST(LastContact, inVainIsNotAgainSoon) {
  LastContact contact(60.0);
  contact.heard({1.0, 2.0}, at(0.0));
  contact.put_off(at(90.0));
  EXPECT_EQ(contact.lost_at(at(150.0)), std::nullopt);
  EXPECT_EQ(contact.lost_at(at(150.1)), Vector2(1.0, 2.0))
      << "and to the same place: it heard of nobody since";
}

TEST(LastContact, eachAttemptInVainIsFollowedByTwiceTheTime) {
  LastContact contact(60.0);
  contact.heard({1.0, 2.0}, at(0.0));
  double now_s = 0.0;
  for (const double wait_s : {60.0, 60.0, 120.0, 240.0, 480.0}) {
    EXPECT_FALSE(contact.lost_at(at(now_s + wait_s)));
    EXPECT_TRUE(contact.lost_at(at(now_s + wait_s + 0.1)));
    now_s += wait_s + 10.0;
    contact.put_off(at(now_s));
  }
  contact.heard({3.0, 4.0}, at(now_s));
  EXPECT_TRUE(contact.lost_at(at(now_s + 60.1))) << "a contact between begins anew";
  for (int i = 0; i < 100; ++i) contact.put_off(at(now_s));
  EXPECT_TRUE(contact.lost_at(at(now_s + 100000.0)));
}

TEST(LastContact, nobodyIsMissedWhoIsHome) {
  LastContact contact(60.0);
  contact.heard({1.0, 2.0}, at(0.0));
  contact.forget();
  EXPECT_EQ(contact.lost_at(at(100.0)), std::nullopt);
}

TEST(LastContact, noTimeMeansNever) {
  LastContact contact(0.0);
  contact.heard({1.0, 2.0}, at(0.0));
  EXPECT_EQ(contact.lost_at(at(1e6)), std::nullopt);
}

}  // namespace
}  // namespace topo::team

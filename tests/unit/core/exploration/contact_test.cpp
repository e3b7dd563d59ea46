// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "tests/unit/core/exploration/toy_decision.hpp"

namespace topo::exploration {
namespace {

using std::chrono::seconds;
using types::Vector2;

/// An exploration that was out of contact for two minutes, of which one is long.
class Contact : public ToyDecision {
 protected:
  [[nodiscard]] Intent out_of_contact(const Vector2& heard_at) const {
    Intent intent;
    intent.phase = Exploring{};
    intent.contact = team::LastContact(60.0);
    intent.contact.heard(heard_at, building_.now() - seconds(120));
    return intent;
  }
  [[nodiscard]] Intent keep(const Situation& now, Intent intent) {
    return keep_contact(now, searches(), params_, std::move(intent));
  }
  void expect_ended(const Intent& intent, const std::string& why) const {
    EXPECT_TRUE(std::holds_alternative<Exploring>(intent.phase));
    EXPECT_FALSE(intent.pursuit.goal);
    EXPECT_FALSE(intent.pursuit.has_target);
    EXPECT_TRUE(has_note(intent, why)) << intent.log.decisions.back().text;
    EXPECT_FALSE(intent.contact.lost_at(building_.now() + seconds(59))) << "put off";
  }

  Vector2 back_ = here() + Vector2(-3.0, 0.0);
};

TEST_F(Contact, InContactNothingChanges) {
  Intent intent = out_of_contact(back_);
  intent.contact.heard(back_, building_.now() - seconds(59));
  const Intent after = keep(situation(), intent);
  EXPECT_TRUE(std::holds_alternative<Exploring>(after.phase));
  EXPECT_EQ(after.pursuit.number, intent.pursuit.number);
  EXPECT_TRUE(after.log.decisions.empty());
}

TEST_F(Contact, LostForLongLeadsBackToWhereAnotherWasHeard) {
  const Intent after = keep(situation(), out_of_contact(back_));
  EXPECT_TRUE(std::holds_alternative<SeekingContact>(after.phase));
  ASSERT_TRUE(after.pursuit.has_target);
  EXPECT_LT((map_.map().centre_of(after.pursuit.target) - back_).norm(), 0.1);
  EXPECT_EQ(after.pursuit.goal->p_map, back_);
  EXPECT_EQ(after.reason, "goes back to where another was last heard");
  EXPECT_TRUE(has_note(after, "out of contact for long"));
}

TEST_F(Contact, TheWayBackGoesOnWithOneGoal) {
  const Intent first = keep(situation(), out_of_contact(back_)), second = keep(situation(), first);
  EXPECT_TRUE(std::holds_alternative<SeekingContact>(second.phase));
  EXPECT_EQ(second.pursuit.number, first.pursuit.number);
  EXPECT_EQ(second.log.decisions.size(), first.log.decisions.size());
}

TEST_F(Contact, HeardAgainTheExplorationGoesOn) {
  Intent seeking = keep(situation(), out_of_contact(back_));
  const auto number = seeking.pursuit.number;
  seeking.contact.heard(here(), building_.now());
  const Intent after = keep(situation(), std::move(seeking));
  expect_ended(after, "in contact again");
  EXPECT_GT(after.pursuit.number, number) << "control's report on the way back is about nothing now";
}

TEST_F(Contact, WhereNobodyIsHeardTheSearchEnds) {
  expect_ended(keep(situation(), out_of_contact(here() + Vector2(0.4, 0.0))), "nobody is heard");
  const Intent seeking = keep(situation(), out_of_contact(back_));
  Situation now = situation();
  now.feedback = {seeking.pursuit.number, true, false};
  expect_ended(keep(now, seeking), "nobody is heard");
  now.feedback.number += 1;
  EXPECT_TRUE(std::holds_alternative<SeekingContact>(keep(now, seeking).phase)) << "about another way";
}

TEST_F(Contact, WithoutAWayTheSearchEnds) {
  expect_ended(keep(situation(), out_of_contact({100.0, 100.0})), "no way to where");
}

TEST_F(Contact, GettingStuckOnTheWayBackEndsIt) {
  const Intent seeking = keep(situation(), out_of_contact(back_));
  Situation now = situation();
  now.feedback = {seeking.pursuit.number, false, true};
  const Intent after = keep(now, seeking);
  expect_ended(after, "no way to where");
  EXPECT_FALSE(after.obstacles.stuck_on().empty());
}

TEST_F(Contact, StandingStillOnTheWayBackEndsIt) {
  const Intent seeking = keep(situation(), out_of_contact(back_));
  Situation now = situation();
  now.now += seconds(25);
  EXPECT_TRUE(std::holds_alternative<SeekingContact>(keep(now, seeking).phase));
  now.now += seconds(1);
  EXPECT_TRUE(std::holds_alternative<Exploring>(keep(now, seeking).phase));
  now.T_map_base.x_m -= 0.6;
  EXPECT_TRUE(std::holds_alternative<SeekingContact>(keep(now, seeking).phase)) << "it gets on";
}

}  // namespace
}  // namespace topo::exploration

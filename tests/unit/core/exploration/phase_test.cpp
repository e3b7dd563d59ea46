// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/phase.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace topo::exploration {
namespace {

std::string text_of(const Phase& phase);

struct TextOf {
  std::string operator()(const Idle&) const { return "idle"; }
  std::string operator()(const Exploring&) const { return "exploring"; }
  std::string operator()(const SeekingContact&) const { return "seeking"; }
  std::string operator()(const Returning& r) const { return r.cut_short ? "returning early" : "returning"; }
  std::string operator()(const WaitingAtHome&) const { return "waiting"; }
  std::string operator()(const GoingTo&) const { return "going"; }
  std::string operator()(const MakingWay& m) const { return "aside(" + std::visit(*this, m.task) + ")"; }
  std::string operator()(const Paused& p) const { return "paused(" + std::visit(*this, p.before) + ")"; }
  std::string operator()(const Done&) const { return "done"; }
  std::string operator()(const Failed&) const { return "failed"; }
};
std::string text_of(const Phase& phase) { return std::visit(TextOf{}, phase); }

const Returning kEarly{"the battery is low", true};
const Passage kPassage{7, {1.0, 2.0}, {}, {3, 4}};

std::vector<Phase> phases() {
  return {Idle{},
          Exploring{},
          SeekingContact{},
          Returning{"explored", false},
          kEarly,
          WaitingAtHome{{"explored", false}},
          GoingTo{},
          MakingWay{kPassage, Exploring{}},
          MakingWay{kPassage, Returning{"explored", false}},
          Paused{Exploring{}},
          Paused{MakingWay{kPassage, GoingTo{}}},
          Done{},
          Failed{}};
}

struct Column {
  std::string name;
  Event event;
  /// What becomes of each of phases(); "" stands for the phase as it was.
  std::array<std::string, 13> becomes;
};

std::vector<Column> table() {
  const std::string same;
  return {
      {"stand",
       event::Ordered{Order::kStand},
       {"idle", "idle", "idle", "idle", "idle", "idle", "idle", "idle", "idle", "idle", "idle", "idle",
        "idle"}},
      {"explore",
       event::Ordered{Order::kExplore},
       {"exploring", "exploring", "exploring", "exploring", "exploring", "exploring", "exploring",
        "exploring", "exploring", "exploring", "exploring", "exploring", "exploring"}},
      {"home",
       event::Ordered{Order::kHome},
       {"returning", "returning", "returning", "returning", "returning", "returning", "returning",
        "returning", "returning", "returning", "returning", "returning", "returning"}},
      {"go to",
       event::Ordered{Order::kGoTo},
       {"going", "going", "going", "going", "going", "going", "going", "going", "going", "going", "going",
        "going", "going"}},
      {"pause",
       event::PauseOrdered{},
       {same, "paused(exploring)", "paused(seeking)", "paused(returning)", "paused(returning early)",
        "paused(waiting)", "paused(going)", "paused(aside(exploring))", "paused(aside(returning))", same,
        same, same, same}},
      {"resume",
       event::ResumeOrdered{},
       {same, same, same, same, same, same, same, same, same, "exploring", "aside(going)", same, same}},
      {"battery low",
       event::BatteryLow{},
       {same, "returning early", "returning early", same, same, same, "returning early", same, same, same,
        same, same, same}},
      {"no goals",
       event::GoalsExhausted{},
       {same, "returning", same, same, same, same, same, same, same, same, same, same, same}},
      {"goal found",
       event::GoalFound{},
       {same, same, same, "exploring", "exploring", "exploring", same, same, same, same, same, same, same}},
      {"contact lost",
       event::ContactLost{},
       {same, "seeking", same, same, same, same, same, same, same, same, same, same, same}},
      {"contact ended",
       event::ContactEnded{},
       {same, same, "exploring", same, same, same, same, same, same, same, same, same, same}},
      {"right of way",
       event::RightOfWay{kPassage},
       {same, "aside(exploring)", "aside(seeking)", "aside(returning)", "aside(returning early)",
        "aside(waiting)", "aside(going)", same, same, same, same, same, same}},
      {"passed",
       event::Passed{},
       {same, same, same, same, same, same, same, "exploring", "returning", same, same, same, same}},
      {"arrived",
       event::Arrived{},
       {same, same, same, "done", "failed", "done", "done", same, same, same, same, same, same}},
      {"mates out",
       event::MatesOut{},
       {same, same, same, "waiting", "waiting", same, same, same, same, same, same, same, same}},
      {"rechecked",
       event::Rechecked{},
       {same, same, same, same, same, "returning", same, same, same, same, same, same, same}},
      {"no progress",
       event::NoProgress{},
       {same, same, same, "failed", "failed", "failed", "failed", same, same, same, same, same, same}},
  };
}

TEST(Phase, EveryPairOfPhaseAndEventLeadsWhereTheTableSays) {
  for (const Column& column : table()) {
    const std::vector<Phase> all = phases();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string expected = column.becomes[i].empty() ? text_of(all[i]) : column.becomes[i];
      EXPECT_EQ(text_of(next(all[i], column.event)), expected) << text_of(all[i]) << ", " << column.name;
    }
  }
}

TEST(Phase, TheTableHasEveryEvent) {
  std::array<bool, std::variant_size_v<Event>> has{};
  for (const Column& column : table()) has.at(column.event.index()) = true;
  for (std::size_t i = 0; i < has.size(); ++i) EXPECT_TRUE(has[i]) << "alternative " << i;
}

TEST(Phase, ThePhasesTriedHaveEveryAlternative) {
  std::array<bool, std::variant_size_v<Phase>> has{};
  for (const Phase& phase : phases()) has.at(phase.index()) = true;
  for (std::size_t i = 0; i < has.size(); ++i) EXPECT_TRUE(has[i]) << "alternative " << i;
}

TEST(Phase, AnEndedMissionStaysEndedUntilTheNextOrder) {
  for (const Phase& ended : {Phase(Idle{}), Phase(Done{}), Phase(Failed{})}) {
    EXPECT_TRUE(has_ended(ended));
    for (const Column& column : table()) {
      if (!std::holds_alternative<event::Ordered>(column.event)) {
        EXPECT_TRUE(has_ended(next(ended, column.event))) << column.name;
      }
    }
  }
}

TEST(Phase, APauseAndItsEndLeaveThePhaseAsItWas) {
  for (const Phase& phase : phases()) {
    if (std::holds_alternative<Paused>(phase)) continue;
    EXPECT_EQ(text_of(next(next(phase, event::PauseOrdered{}), event::ResumeOrdered{})), text_of(phase));
  }
}

TEST(Phase, AReasonToReturnIsKeptThroughInterruptions) {
  Phase phase = next(Exploring{}, event::BatteryLow{});
  phase = next(next(phase, event::RightOfWay{kPassage}), event::PauseOrdered{});
  EXPECT_TRUE(is_homing(phase));
  phase = next(next(phase, event::ResumeOrdered{}), event::Passed{});
  ASSERT_TRUE(std::holds_alternative<Returning>(phase));
  EXPECT_EQ(std::get<Returning>(phase).why, "the battery is low");
  EXPECT_TRUE(std::get<Returning>(phase).cut_short);
}

TEST(Phase, WaitingAtHomeAndSeekingAreSeenThroughAPause) {
  EXPECT_TRUE(is_waiting_at_home(next(WaitingAtHome{}, event::PauseOrdered{})));
  EXPECT_FALSE(is_waiting_at_home(next(WaitingAtHome{}, event::RightOfWay{kPassage}))) << "it moves";
  EXPECT_TRUE(is_seeking_contact(next(SeekingContact{}, event::PauseOrdered{})));
  EXPECT_TRUE(is_seeking_contact(next(SeekingContact{}, event::RightOfWay{kPassage})));
  EXPECT_FALSE(is_seeking_contact(Exploring{}));
}

}  // namespace
}  // namespace topo::exploration

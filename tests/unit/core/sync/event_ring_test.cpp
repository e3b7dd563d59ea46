// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/sync/event_ring.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace topo::sync {
namespace {

TEST(EventRing, BringsEventsInOrder) {
  EventRing<4> events;
  EXPECT_TRUE(events.post(100, 7, Severity::kWarning, {1, 2, 3}, "laser_front"));
  EXPECT_TRUE(events.post(200, 8, Severity::kError));
  std::vector<std::uint16_t> ids;
  EXPECT_EQ(events.drain([&](const Event& e) { ids.push_back(e.id); }), 2U);
  EXPECT_EQ(ids, (std::vector<std::uint16_t>{7, 8}));
  EXPECT_EQ(events.front(), nullptr);
}

TEST(EventRing, CarriesEverythingOfAnEvent) {
  EventRing<4> events;
  events.post(100, 7, Severity::kWarning, {1, -2, 3}, "laser_front");
  const Event* e = events.front();
  ASSERT_NE(e, nullptr);
  EXPECT_EQ(e->stamp_ns, 100);
  EXPECT_EQ(e->severity, Severity::kWarning);
  EXPECT_EQ(e->args[1], -2);
  EXPECT_EQ(e->text_view(), "laser_front");
}

TEST(EventRing, CountsWhatFindsNoRoom) {
  EventRing<4> events;
  for (std::uint16_t i = 0; i < 6; ++i) events.post(i, i, Severity::kInfo);
  EXPECT_EQ(events.lost(), 2U);
  std::vector<std::uint16_t> ids;
  events.drain([&](const Event& e) { ids.push_back(e.id); });
  EXPECT_EQ(ids, (std::vector<std::uint16_t>{0, 1, 2, 3}));
}

TEST(EventRing, ASlotUsedAgainDoesNotShowOldText) {
  EventRing<2> events;
  for (int i = 0; i < 3; ++i) {
    events.post(i, 1, Severity::kInfo, {}, i == 0 ? "a long text" : "b");
    EXPECT_EQ(events.front()->text_view(), i == 0 ? "a long text" : "b");
    events.pop();
  }
}

TEST(EventRing, DrainTakesOneRingfulAtMost) {
  EventRing<4> events;
  events.post(0, 0, Severity::kInfo);
  int seen = 0;
  const std::size_t taken = events.drain([&](const Event&) {
    ++seen;
    events.post(0, 0, Severity::kInfo);  // a producer that never stops
  });
  EXPECT_EQ(taken, 4U);
  EXPECT_EQ(seen, 4);
}

TEST(Event, CutsTextBetweenCharacters) {
  Event e;
  e.set_text(std::string(60, 'x'));
  EXPECT_EQ(e.text_view().size(), Event::kMaxText);
  e.set_text(std::string(47, 'x') + "\xC3\xA9" + "tail");  // the two-byte character does not fit
  EXPECT_EQ(e.text_view(), std::string(47, 'x'));
  e.set_text(std::string(46, 'x') + "\xC3\xA9");
  EXPECT_EQ(e.text_view().size(), 48U);
}

}  // namespace
}  // namespace topo::sync

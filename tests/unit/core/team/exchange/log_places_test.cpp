// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <set>

#include "core/team/exchange/codecs.hpp"
#include "core/team/exchange/exchange_state.hpp"
#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

const slam::Origin kRobot{1, 1};

StatusMessage saying(std::vector<types::Vector2> visited, std::vector<types::Vector2> looked) {
  StatusMessage status;
  status.visited = std::move(visited);
  status.looked = std::move(looked);
  return status;
}

void append(ItemStore& store, const std::vector<LogBody>& bodies) {
  for (const LogBody& body : bodies) {
    const ItemStream* log = store.stream({ItemKind::kLog, kRobot});
    const ItemKey key{{ItemKind::kLog, kRobot}, log != nullptr ? log->end() : 0};
    store.insert(key, std::make_shared<const std::vector<std::byte>>(encode_log(body)));
  }
}

TEST(LogPlaces, OnlyWhatChangedBecomesAnEntry) {
  ItemStore store;
  EXPECT_TRUE(changes(places_of(store, kRobot), saying({}, {})).empty());
  append(store, changes(places_of(store, kRobot), saying({{1.0, 2.0}}, {{3.0, 4.0}})));
  EXPECT_EQ(store.size(), 2U);
  EXPECT_TRUE(changes(places_of(store, kRobot), saying({{1.0, 2.0}}, {{3.0, 4.0}})).empty());
  append(store, changes(places_of(store, kRobot), saying({}, {{3.0, 4.0}})));
  EXPECT_EQ(store.size(), 3U) << "a goal once more";
  EXPECT_TRUE(places_of(store, kRobot).visited.empty());
  EXPECT_EQ(places_of(store, kRobot).looked.size(), 1U);
}

TEST(LogPlaces, AnotherRunHasItsOwn) {
  ItemStore store;
  append(store, {Visited{{1.0, 2.0}, false}});
  EXPECT_TRUE(places_of(store, {1, 2}).visited.empty());
}

TEST(LogPlaces, TheLogFollowsWhateverIsSaid) {
  EXPECT_TRUE(rc::check([] {
    ItemStore store;
    const auto lists = *rc::gen::container<std::vector<std::vector<int>>>(
        rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 6)));
    for (const std::vector<int>& list : lists) {
      std::vector<types::Vector2> places;
      for (const int place : std::set<int>(list.begin(), list.end())) places.emplace_back(place, 0.5);
      append(store, changes(places_of(store, kRobot), saying(places, {})));
      auto held = places_of(store, kRobot).visited;
      std::sort(held.begin(), held.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
      RC_ASSERT(held == places);
    }
  }));
}

}  // namespace
}  // namespace topo::team

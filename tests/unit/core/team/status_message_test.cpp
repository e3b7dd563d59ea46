// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/status_message.hpp"

#include <gtest/gtest.h>

namespace topo::team {
namespace {

TEST(InFrame, MovesEveryPlaceOfAMessage) {
  StatusMessage message;
  message.T_map_base = {1.0, 0.0, 0.0};
  message.home = types::Vector2(2.0, 0.0);
  message.claim = Bid{{3.0, 0.0}, 1.0};
  message.bids = {{{4.0, 0.0}, 1.0}};
  message.visited = message.looked = message.way_map = {{5.0, 0.0}};
  const types::Vector2 by(10.0, 20.0);
  const StatusMessage moved = in_frame({by.x(), by.y(), 0.0}, message);
  EXPECT_EQ(moved.T_map_base.translation(), types::Vector2(1.0, 0.0) + by);
  EXPECT_EQ(moved.start, message.start + by);
  EXPECT_EQ(*moved.home, *message.home + by);
  EXPECT_EQ(moved.claim->p_map, message.claim->p_map + by);
  EXPECT_EQ(moved.bids.front().p_map, message.bids.front().p_map + by);
  for (const auto* places : {&moved.visited, &moved.looked, &moved.way_map})
    EXPECT_EQ(places->front(), types::Vector2(5.0, 0.0) + by);
}

}  // namespace
}  // namespace topo::team

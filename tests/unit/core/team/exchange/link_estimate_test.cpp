// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/link_estimate.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

using testing::at;

TEST(LinkEstimate, LossIsTheShareThatDidNotCome) {
  LinkEstimate link;
  EXPECT_FALSE(link.loss_in());
  for (std::uint32_t counter = 0; counter < 1'000; ++counter) {
    if (counter % 4 != 1) link.note_datagram(counter);
  }
  ASSERT_TRUE(link.loss_in());
  EXPECT_NEAR(*link.loss_in(), 0.25, 0.03);
  EXPECT_NEAR(link.echo({1, 1}, at(0.0)).lost_255 / 255.0, 0.25, 0.03);
}

TEST(LinkEstimate, RoundTripLeavesOutWhatTheMateHeldIt) {
  LinkEstimate link;
  link.note_presence(5'000'000, Echo{{1, 1}, in_ms(at(0.0)), 300, 51}, at(0.4));
  ASSERT_TRUE(link.round_trip_s());
  EXPECT_NEAR(*link.round_trip_s(), 0.1, 1e-6);
  EXPECT_NEAR(*link.loss_out(), 0.2, 1e-6);
  EXPECT_NEAR(*link.clock_offset_s(), 5'000.0 + 0.05 - types::to_seconds(at(0.4)), 1e-3);
}

TEST(LinkEstimate, AnEchoOfNonsenseIsLeftOut) {
  LinkEstimate link;
  link.note_presence(1, Echo{{1, 1}, in_ms(at(9'000.0)), 0, 0}, at(0.0));
  link.note_presence(1, Echo{{1, 1}, 0, ~std::uint64_t{0}, 0}, at(0.1));
  link.note_presence(1, Echo{{1, 1}, 0, 0, 0}, at(0.2));
  EXPECT_FALSE(link.round_trip_s());
}

TEST(LinkEstimate, AnEchoSaysHowLongItWasHeld) {
  LinkEstimate link;
  link.note_presence(777, std::nullopt, at(1.0));
  const Echo echo = link.echo({4, 5}, at(1.25));
  EXPECT_EQ(echo.mate, (slam::Origin{4, 5}));
  EXPECT_EQ(echo.stamp_ms, 777U);
  EXPECT_EQ(echo.held_ms, 250U);
}

TEST(Presence, IsReadAsWrittenAndOnlyWhole) {
  const Presence presence{123'456'789, {{{2, 3}, 55, 66, 77}, {{4, 5}, 0, 0, 255}}};
  const auto bytes = encode_presence(presence);
  const auto read = decode_presence(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->stamp_ms, presence.stamp_ms);
  ASSERT_EQ(read->echoes.size(), 2U);
  EXPECT_EQ(read->echoes[1].mate, (slam::Origin{4, 5}));
  EXPECT_EQ(read->echoes[0].lost_255, 77U);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(decode_presence(std::span(bytes).first(size))) << size;
}

}  // namespace
}  // namespace topo::team

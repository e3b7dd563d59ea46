// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/config_packet.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/unit/drivers/pioneer/config_payload.hpp"
#include "tests/unit/drivers/pioneer/hex.hpp"

namespace topo::pioneer {
namespace {

TEST(ConfigPacket, DecodesATypicalRobot) {
  const auto c = decode_config(config_payload({}));
  ASSERT_TRUE(c);
  EXPECT_EQ(c->robot_class, "Pioneer");
  EXPECT_EQ(c->subclass, "p3dx-sh");
  EXPECT_EQ(c->serial_number, "SN123");
  EXPECT_EQ(c->name, "scripted");
  EXPECT_EQ(c->rot_velocity_top_degps, 360);
  EXPECT_EQ(c->velocity_top_mmps, 1500);
  EXPECT_EQ(c->acceleration_top_mmps2, 2000);
  EXPECT_EQ(c->sip_cycle_ms, 100);
  EXPECT_EQ(c->low_battery_decivolt, 110);
  EXPECT_EQ(c->watchdog_ms, 2000);
  EXPECT_EQ(c->front_bumps, 1);
  EXPECT_EQ(c->auto_baud, 1);
  EXPECT_EQ(c->ticks_per_mm, 138);
  EXPECT_EQ(c->shutdown_decivolt, 105);
  EXPECT_EQ(c->firmware, "2.9");
}

TEST(ConfigPacket, WhatIsMissingAtTheEndIsZero) {
  const Bytes whole = config_payload({});
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const auto c = decode_config(std::span(whole).first(size));
    if (!c) continue;
    EXPECT_TRUE(c->watchdog_ms == 2000 || c->watchdog_ms == 0) << size;
  }
  EXPECT_FALSE(decode_config({}));
  EXPECT_FALSE(decode_config(std::span(whole).first(1)));
}

TEST(ConfigPacket, RejectsAnotherType) {
  Bytes payload = config_payload({});
  payload[0] = std::byte{0x32};
  EXPECT_FALSE(decode_config(payload));
}

TEST(ConfigPacket, AnyBytesAreSafeAndNamesArePrintable) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint8_t>& tail) {
    const auto c = decode_config(Bytes{std::byte{0x20}} + to_bytes(std::as_bytes(std::span(tail))));
    if (!c) return;
    for (const std::string* s : {&c->robot_class, &c->subclass, &c->serial_number, &c->name, &c->firmware})
      for (const char ch : *s) RC_ASSERT(ch >= 0x20 && ch < 0x7F);
  }));
}

}  // namespace
}  // namespace topo::pioneer

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/can_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/io/bus_faults.hpp"

namespace topo::io {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

CanError decode(std::uint32_t id, std::vector<int> bytes = {}) {
  std::vector<std::byte> data;
  for (const int byte : bytes) data.push_back(static_cast<std::byte>(byte));
  return decode_can_error(id, data);
}

// Numbers of PROTOCOLS section 14.3.
TEST(CanError, KnowsEveryClassThatMatters) {
  EXPECT_TRUE(decode(0x20000040).bus_off);
  EXPECT_TRUE(decode(0x100).restarted);
  EXPECT_TRUE(decode(0x20).no_acknowledge);
  EXPECT_TRUE(decode(0x1).transmit_timeout);
  EXPECT_TRUE(decode(0x4, {0, 0x10}).passive);
  EXPECT_TRUE(decode(0x4, {0, 0x20}).passive);
  EXPECT_TRUE(decode(0x4, {0, 0x01}).overflow);
  EXPECT_TRUE(decode(0x8, {0, 0, 0x02, 0x03}).violation);
}

TEST(CanError, SeesAMissingAcknowledgementAtItsPlaceInTheFrame) {
  const CanError error = decode(0x8 | 0x80, {0, 0, 0, 0x19});
  EXPECT_TRUE(error.no_acknowledge);
  EXPECT_FALSE(error.violation);
}

TEST(CanError, TakesCountersOnlyWhereTheyAre) {
  EXPECT_EQ(decode(0x200, {0, 0, 0, 0, 0, 0, 136, 7}).counters, (CanErrorCounters{136, 7}));
  EXPECT_EQ(decode(0x4, {0, 0x20, 0, 0, 0, 0, 128, 0}).counters, (CanErrorCounters{128, 0}));
  EXPECT_FALSE(decode(0x20, {0, 0, 0, 0, 0, 0, 136, 7}).counters);
}

TEST(CanError, SpeaksPlainlyTheGravestFirst) {
  EXPECT_THAT(to_text(decode(0x40 | 0x4, {0, 0x20})), StartsWith("bus-off"));
  EXPECT_THAT(to_text(decode(0x20 | 0x200, {0, 0, 0, 0, 0, 0, 128, 0})),
              HasSubstr("nobody acknowledges what is sent (error counters: transmit 128, receive 0)"));
  EXPECT_EQ(to_text(decode(0x2)), "nothing of importance");
}

TEST(CanError, SaysWhatIsCountedAsTheDoctorSaysIt) {
  CanError error;
  error.passive = error.violation = error.transmit_timeout = error.overflow = error.restarted = true;
  BusFaults faults;
  for (const BusFault fault : {BusFault::kPassive, BusFault::kViolation, BusFault::kTransmitTimeout,
                               BusFault::kOverflow, BusFault::kRestarted})
    faults[fault] = 1;
  std::string counted = to_text(faults);
  for (std::size_t at = 0; (at = counted.find("1 x ")) != std::string::npos;) counted.erase(at, 4);
  EXPECT_EQ(to_text(error), counted);
}

TEST(CanError, AShortFrameIsNoTrap) {
  const CanError error = decode(0x4 | 0x8 | 0x200);
  EXPECT_FALSE(error.passive);
  EXPECT_EQ(error.counters, (CanErrorCounters{0, 0}));
}

}  // namespace
}  // namespace topo::io

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/search_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;

TEST(SearchNotes, WhatHoldsForAllUnitsOfABusIsToldOnce) {
  std::vector<Fruitless> places;
  for (const char* unit : {"can:can0:0", "can:can0:1"})
    places.push_back({unit, false, std::string(unit) + ": the interface is off; ip link set can0 up"});
  EXPECT_THAT(notes_of(places),
              ElementsAre("can:can0:0, can:can0:1: the interface is off; ip link set can0 up"));
}

TEST(SearchNotes, SilentPlacesComeLastInOneSentence) {
  const std::vector<Fruitless> places{{"serial:/dev/ttyS0", false, ""},
                                      {"tcp:10.0.0.1:10940", true, ""},
                                      {"serial:/dev/ttyS1", false, ""},
                                      {"serial:/dev/ttyUSB0", false, "permission denied"}};
  EXPECT_THAT(notes_of(places),
              ElementsAre("tcp:10.0.0.1:10940: something answers, and does not say in time what it is",
                          "serial:/dev/ttyUSB0: permission denied",
                          "nothing answers at serial:/dev/ttyS0, serial:/dev/ttyS1"));
}

TEST(SearchNotes, NothingToTellIsNothing) { EXPECT_TRUE(notes_of({}).empty()); }

}  // namespace
}  // namespace topo::daemon

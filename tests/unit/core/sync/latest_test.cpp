// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/sync/latest.hpp"

#include <gtest/gtest.h>

#include <string>

namespace topo::sync {
namespace {

TEST(Latest, HasNothingAtFirst) {
  Latest<int> latest;
  EXPECT_EQ(latest.read(), nullptr);
  EXPECT_EQ(latest.take_new(), nullptr);
}

TEST(Latest, GivesTheNewestAndCountsWhatNobodyTook) {
  Latest<std::string> latest;
  latest.store("one");
  latest.store("two");
  latest.store("three");
  ASSERT_NE(latest.read(), nullptr);
  EXPECT_EQ(*latest.read(), "three");
  EXPECT_EQ(latest.overwritten(), 2U);
}

TEST(Latest, TakesAValueOnceButReadsItAgain) {
  Latest<int> latest;
  latest.store(1);
  ASSERT_NE(latest.take_new(), nullptr);
  EXPECT_EQ(latest.take_new(), nullptr);
  EXPECT_EQ(*latest.read(), 1);
  latest.store(2);
  EXPECT_EQ(*latest.take_new(), 2);
  EXPECT_EQ(latest.overwritten(), 0U);
}

TEST(Latest, TheReadersValueStaysWhileTheWriterGoesOn) {
  Latest<int> latest;
  latest.store(1);
  const int* held = latest.read();
  for (int i = 2; i < 10; ++i) {
    latest.store(i);
    EXPECT_EQ(*held, 1);
    EXPECT_NE(&latest.writable(), held);
  }
  EXPECT_EQ(*latest.read(), 9);
  EXPECT_EQ(latest.overwritten(), 7U);
}

}  // namespace
}  // namespace topo::sync

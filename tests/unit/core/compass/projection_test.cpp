// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/projection.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

namespace topo::compass {
namespace {

constexpr std::size_t kHalfBins = 40;

std::vector<std::int32_t> some_half_bins() {
  return *rc::gen::container<std::vector<std::int32_t>>(rc::gen::inRange<std::int32_t>(0, kHalfBins));
}

TEST(Histogram, KeepsItsSumUpToDateAsIfItWereMadeAnew) {
  EXPECT_TRUE(rc::check([] {
    Histogram kept(kHalfBins), fresh(kHalfBins);
    for (int step = 0; step < 5; ++step) {
      const auto come = some_half_bins();
      kept.add_few(come, 1);
      fresh.add(come, 1);
      const auto gone = std::span(come).first(come.size() / 2);
      kept.add_few(gone, -1);
      fresh.add(gone, -1);
      RC_ASSERT(kept.sum() == fresh.sum());
    }
  }));
}

TEST(Histogram, OfManyPointsInABinIsExactAsWell) {
  Histogram kept(kHalfBins), fresh(kHalfBins);
  const std::vector<std::int32_t> same(3000, 7), few(50, 8);
  for (Histogram* const histogram : {&kept, &fresh}) histogram->add(same, 1);
  EXPECT_EQ(kept.sum(), fresh.sum());
  kept.add_few(few, 1);
  fresh.add(few, 1);
  EXPECT_EQ(kept.sum(), fresh.sum());
}

}  // namespace
}  // namespace topo::compass

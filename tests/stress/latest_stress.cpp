// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The reader of a triple buffer sees whole values that only get newer, and the last one at the end.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

#include "core/sync/histogram.hpp"
#include "core/sync/latest.hpp"
#include "tests/stress/yielding.hpp"

namespace topo::sync {
namespace {

struct Plan {
  std::uint64_t revision = 0;
  std::array<std::uint64_t, 64> route{};
};

template <class Steps>
void check_latest(std::uint64_t plans) {
  Latest<Plan, Steps> latest;
  std::uint64_t taken = 0;
  std::uint64_t wrong = 0;
  std::thread reader([&] {
    std::uint64_t last = 0;
    while (last != plans) {
      const Plan* plan = latest.take_new();
      if (plan == nullptr) {
        std::this_thread::yield();
        continue;
      }
      ++taken;
      if (plan->revision <= last) ++wrong;
      last = plan->revision;
      for (const std::uint64_t r : plan->route) wrong += r != last ? 1U : 0U;
    }
  });
  for (std::uint64_t revision = 1; revision <= plans; ++revision) {
    Plan& plan = latest.writable();
    plan.revision = revision;
    plan.route.fill(revision);
    latest.publish();
  }
  reader.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(taken + latest.overwritten(), plans);
}

TEST(LatestStress, IsMonotonicWholeAndCountsWhatWasReplaced) { check_latest<Undisturbed>(200000); }
TEST(LatestStressYielding, IsMonotonicWholeAndCountsWhatWasReplaced) {
  check_latest<stress::Yielding>(20000);
}

TEST(HistogramStress, CanBeReadWhileItIsWritten) {
  constexpr std::uint64_t kRecords = 100000;
  Histogram histogram;
  std::uint64_t wrong = 0;
  std::thread reader([&] {
    std::uint64_t last = 0;
    while (last < kRecords) {
      const LatencySummary s = histogram.summary();
      if (s.count < last || s.p50_ns > 1032 || s.max_ns > 1000) ++wrong;
      last = s.count;
    }
  });
  for (std::uint64_t i = 0; i < kRecords; ++i) histogram.record(static_cast<std::int64_t>(i % 1001));
  reader.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(histogram.count(), kRecords);
}

}  // namespace
}  // namespace topo::sync

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/sampling.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/core/walls/points.hpp"

namespace topo::compass {
namespace {

using walls::Points;

Points grid(int width, int height) {
  Points points;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) points.emplace_back(0.05 * x, 0.05 * y);
  return points;
}

TEST(Samples, UpToALimitAreThoseWithNoGreaterHash) {
  EXPECT_TRUE(rc::check([] {
    const Points points = grid(*rc::gen::inRange(1, 60), *rc::gen::inRange(1, 60));
    const std::uint64_t limit = *rc::gen::arbitrary<std::uint64_t>();
    const Placing placing{{0.0, 0.0}, 0.05, 0.0};
    const Samples samples(points);
    const auto expected =
        std::ranges::count_if(points, [&](const auto& p) { return Sample(p).hash <= limit; });
    RC_ASSERT(samples.up_to(limit, placing).x.size() == static_cast<std::size_t>(expected));
    RC_ASSERT(samples.up_to(UINT64_MAX, placing).x.size() == points.size());
  }));
}

TEST(Samples, UpToALimitLieFarFromEachOther) {
  const Points points = grid(100, 100);
  const Placing placing{{2.5, 2.5}, 0.05, 0.0};
  const Cloud cloud = Samples(points).up_to(hash_limit(points.size(), points.size() / 2), placing);
  EXPECT_NEAR(static_cast<double>(cloud.x.size()), 5000.0, 300.0);
  std::size_t beside = 0;
  for (std::size_t k = 1; k < cloud.x.size(); ++k)
    if (std::hypot(cloud.x[k] - cloud.x[k - 1], cloud.y[k] - cloud.y[k - 1]) < 4.0F) ++beside;
  EXPECT_LT(beside, cloud.x.size() / 20);
}

TEST(HashLimit, IsTheShareOfAllHashes) {
  EXPECT_EQ(hash_limit(100, 100), UINT64_MAX);
  EXPECT_EQ(hash_limit(100, 200), UINT64_MAX);
  EXPECT_EQ(hash_limit(100, 0), 0U);
  EXPECT_EQ(hash_limit(4, 1), std::uint64_t{1} << 62U);
  EXPECT_EQ(hash_limit(2, 1), std::uint64_t{1} << 63U);
  std::uint64_t before = 0;
  for (std::size_t size = 1; size <= 1000; ++size) {
    EXPECT_GT(hash_limit(1000, size), before) << size;
    before = hash_limit(1000, size);
  }
}

TEST(HashLimit, LetsAboutAsManyPointsThrough) {
  const Points points = grid(200, 150);
  for (const std::size_t size : {300U, 3000U, 15000U, 29000U}) {
    const auto count =
        Samples(points).up_to(hash_limit(points.size(), size), {{0.0, 0.0}, 0.05, 0.0}).x.size();
    // Five standard deviations of as many independent draws.
    const double share = static_cast<double>(size) / static_cast<double>(points.size());
    EXPECT_NEAR(static_cast<double>(count), static_cast<double>(size),
                5.0 * std::sqrt(static_cast<double>(size) * (1.0 - share)));
  }
}

TEST(Sample, LiesInItsCellWhereverThatIs) {
  const Placing placing{{1.0, -2.0}, 0.05, 0.04};
  Cloud cloud;
  const Points points = grid(40, 40);
  double sum_x = 0.0, sum_y = 0.0;
  for (const types::Vector2& p : points) {
    Sample(p).append_to(cloud, placing);
    const double x_m = static_cast<double>(cloud.x.back()) * 0.05 + 1.0 - p.x();
    const double y_m = static_cast<double>(cloud.y.back()) * 0.05 - 2.0 - p.y();
    EXPECT_LE(std::abs(x_m), 0.02 + 1e-5);
    EXPECT_LE(std::abs(y_m), 0.02 + 1e-5);
    sum_x += x_m;
    sum_y += y_m;
  }
  // Spread evenly over the cell: the mean of 1600 is off by 0.3 mm.
  EXPECT_NEAR(sum_x / 1600.0, 0.0, 0.0015);
  EXPECT_NEAR(sum_y / 1600.0, 0.0, 0.0015);
  Cloud exact;
  Sample({1.1, -2.2}).append_to(exact, {{1.0, -2.0}, 0.05, 0.0});
  EXPECT_NEAR(exact.x[0], 2.0F, 1e-5F);
  EXPECT_NEAR(exact.y[0], -4.0F, 1e-5F);
}

}  // namespace
}  // namespace topo::compass

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/sampling.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "core/compass/points_change.hpp"
#include "tests/unit/core/walls/points.hpp"

namespace topo::compass {
namespace {

using walls::Points;

Points within(const Samples& samples, std::uint64_t least, std::uint64_t most) {
  Points points;
  samples.for_each_within(least, most, [&](const Sample& sample) { points.push_back(sample.p); });
  std::sort(points.begin(), points.end(), comes_before);
  return points;
}

Points grid(int width, int height) {
  Points points;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) points.emplace_back(0.05 * x, 0.05 * y);
  return points;
}

TEST(Samples, BetweenTwoLimitsAreThoseOfThePointsPresent) {
  EXPECT_TRUE(rc::check([] {
    Points points = grid(*rc::gen::inRange(1, 60), *rc::gen::inRange(1, 60));
    Samples samples(points);
    for (int k = *rc::gen::inRange(0, 50); k > 0; --k) {
      if (points.size() > 1 && *rc::gen::inRange(0, 2) == 0) {
        const auto gone = points.begin() + *rc::gen::inRange<std::ptrdiff_t>(0, std::ssize(points));
        samples.remove(*gone);
        points.erase(gone);
      } else {
        points.emplace_back(0.05 * *rc::gen::inRange(-20, 20), 0.05 * *rc::gen::inRange(-20, 20));
        samples.add(points.back());
      }
    }
    const auto [least, most] = std::minmax(
        {*rc::gen::arbitrary<std::uint64_t>(), *rc::gen::arbitrary<std::uint64_t>(), hash_limit(2, 1)});
    std::sort(points.begin(), points.end(), comes_before);
    RC_ASSERT(within(samples, 0, UINT64_MAX) == points);
    std::erase_if(points, [&](const auto& p) { return Sample(p).hash < least || Sample(p).hash > most; });
    RC_ASSERT(within(samples, least, most) == points);
    RC_ASSERT(samples.up_to(most, {}).x.size() == within(samples, 0, most).size());
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

}  // namespace
}  // namespace topo::compass

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/projection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

namespace topo::compass {
namespace {

/// Points within a distance from the centre, in half bins.
Cloud random_cloud(std::size_t count, float radius, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-radius, radius);
  Cloud cloud;
  while (cloud.x.size() < count) {
    const float x = place(random), y = place(random);
    if (std::hypot(x, y) > radius) continue;
    cloud.x.push_back(x);
    cloud.y.push_back(y);
  }
  return cloud;
}

/// Entropy of how values are spread over bins that are two half bins wide and begin at each half bin.
double spread_entropy(const std::vector<double>& values, double offset) {
  std::map<long, int> bins;
  for (const double value : values) {
    const long half_bin = std::lround(std::floor(value + offset));
    ++bins[half_bin];
    ++bins[half_bin + 1];
  }
  double entropy = 0.0;
  for (const auto& [bin, points] : bins) {
    const double share = points / (2.0 * static_cast<double>(values.size()));
    entropy -= share * std::log(share);
  }
  return entropy;
}

TEST(Histogram, SumIsThatOfNLogNOverPairsOfHalfBins) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const std::size_t size = 1 + random() % 50;
    std::vector<std::int32_t> half_bins;
    for (std::size_t k = random() % 400; k > 0; --k)
      half_bins.push_back(static_cast<std::int32_t>(random() % size));
    Histogram histogram(size);
    histogram.add(half_bins);
    double expected = 0.0;
    for (std::int32_t pair = -1; pair < static_cast<std::int32_t>(size); ++pair) {
      const auto n = static_cast<double>(
          std::ranges::count_if(half_bins, [=](std::int32_t h) { return h == pair || h == pair + 1; }));
      if (n > 0.0) expected += n * std::log(n);
    }
    EXPECT_NEAR(histogram.sum(), expected, 1e-5 * (1.0 + expected)) << seed;
  }
}

TEST(Projection, EntropyIsThatOfBothProjections) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const float radius = 10.0F + static_cast<float>(random() % 40);
    const double angle = static_cast<double>(random() % 157) / 100.0;
    const Cloud cloud = random_cloud(500, radius, random);
    std::vector<double> along, across;
    for (std::size_t i = 0; i < cloud.x.size(); ++i) {
      const auto x = static_cast<double>(cloud.x[i]), y = static_cast<double>(cloud.y[i]);
      along.push_back(std::cos(angle) * x + std::sin(angle) * y);
      across.push_back(std::cos(angle) * y - std::sin(angle) * x);
    }
    const Projection projection(radius, angle, cloud);
    // The middle of the half bins is half a half bin off; a point at an edge may fall to either side.
    EXPECT_NEAR(projection.entropy(), spread_entropy(along, 0.5) + spread_entropy(across, 0.5), 2e-3) << seed;
  }
}

TEST(Projection, AQuarterTurnExchangesTheTwo) {
  std::mt19937 random(5);
  const Cloud cloud = random_cloud(2000, 30.0F, random);
  for (const double angle : {0.0, 0.3, 0.8, 1.2}) {
    const Projection here(30.0F, angle, cloud), turned(30.0F, angle + std::numbers::pi / 2.0, cloud);
    EXPECT_NEAR(here.entropy(), turned.entropy(), 0.01) << angle;
  }
}

TEST(Projection, OfAWallIsLeastAlongIt) {
  Cloud wall;
  for (int i = -400; i <= 400; ++i) {
    wall.x.push_back(0.1F * static_cast<float>(i) * std::cos(0.6F));
    wall.y.push_back(0.1F * static_cast<float>(i) * std::sin(0.6F));
  }
  const auto entropy = [&](double angle) { return Projection(41.0F, angle, wall).entropy(); };
  for (const double off : {0.1, 0.2, 0.4, 0.7}) {
    EXPECT_LT(entropy(0.6), entropy(0.6 + off)) << off;
    EXPECT_LT(entropy(0.6), entropy(0.6 - off)) << off;
  }
}

}  // namespace
}  // namespace topo::compass

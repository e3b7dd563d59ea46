// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/projection.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
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
    histogram.add(half_bins, 1);
    double expected = 0.0;
    for (std::int32_t pair = -1; pair < static_cast<std::int32_t>(size); ++pair) {
      const auto n = static_cast<double>(
          std::ranges::count_if(half_bins, [=](std::int32_t h) { return h == pair || h == pair + 1; }));
      if (n > 0.0) expected += n * std::log(n);
    }
    EXPECT_NEAR(histogram.sum(), expected, 1e-5 * (1.0 + expected)) << seed;
    histogram.add(half_bins, -1);
    EXPECT_EQ(histogram.sum(), 0.0) << "nothing is left";
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
    Projection projection(radius, angle);
    projection.add(cloud);
    // The middle of the half bins is half a half bin off; a point at an edge may fall to either side.
    EXPECT_NEAR(projection.entropy(), spread_entropy(along, 0.5) + spread_entropy(across, 0.5), 2e-3) << seed;
  }
}

TEST(Projection, AQuarterTurnExchangesTheTwo) {
  std::mt19937 random(5);
  const Cloud cloud = random_cloud(2000, 30.0F, random);
  for (const double angle : {0.0, 0.3, 0.8, 1.2}) {
    Projection here(30.0F, angle), turned(30.0F, angle + std::numbers::pi / 2.0);
    here.add(cloud);
    turned.add(cloud);
    EXPECT_NEAR(here.entropy(), turned.entropy(), 0.01) << angle;
  }
}

TEST(Projection, AddedInPartsAndRemovedIsAsIfItHadNotBeen) {
  std::mt19937 random(6);
  const Cloud stays = random_cloud(3000, 50.0F, random);
  Projection expected(50.0F, 0.4);
  expected.add(stays);
  // Few points are counted in one way, many in another.
  for (const std::size_t count : {1U, 5U, 12U, 13U, 14U, 255U, 256U, 257U, 1000U}) {
    const Cloud goes = random_cloud(count, 50.0F, random);
    Projection projection(50.0F, 0.4);
    projection.add(goes);
    projection.add(stays);
    const double with_both = projection.entropy();
    projection.remove(goes);
    EXPECT_EQ(projection.entropy(), expected.entropy()) << count;
    projection.add(goes);
    EXPECT_EQ(projection.entropy(), with_both) << count;
  }
}

TEST(Projection, OfAWallIsLeastAlongIt) {
  Cloud wall;
  for (int i = -400; i <= 400; ++i) {
    wall.x.push_back(0.1F * static_cast<float>(i) * std::cos(0.6F));
    wall.y.push_back(0.1F * static_cast<float>(i) * std::sin(0.6F));
  }
  const auto entropy = [&](double angle) {
    Projection projection(41.0F, angle);
    projection.add(wall);
    return projection.entropy();
  };
  for (const double off : {0.1, 0.2, 0.4, 0.7}) {
    EXPECT_LT(entropy(0.6), entropy(0.6 + off)) << off;
    EXPECT_LT(entropy(0.6), entropy(0.6 - off)) << off;
  }
}

}  // namespace
}  // namespace topo::compass

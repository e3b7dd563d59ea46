// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/k_means.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/unit/core/team/generators.hpp"

namespace topo::team {
namespace {

using testing::arbitrary_points;
using types::Vector2;

using Labels = std::map<std::pair<double, double>, std::size_t>;

Labels labels_of(const std::vector<Vector2>& points, std::size_t k) {
  Labels labels;
  const std::vector<std::size_t> cluster = k_means(points, k);
  for (std::size_t i = 0; i < points.size(); ++i) labels[{points[i].x(), points[i].y()}] = cluster[i];
  return labels;
}

TEST(KMeans, theOrderAndRepetitionOfPointsDoNotMatter) {
  EXPECT_TRUE(rc::check("a function of the set", [] {
    const std::vector<Vector2> points = arbitrary_points(30);
    const auto k = *rc::gen::inRange<std::size_t>(1, 6);
    std::vector<Vector2> twice = points;
    twice.insert(twice.end(), points.begin(), points.end());
    RC_ASSERT(labels_of(testing::shuffled(twice), k) == labels_of(points, k));
  }));
}

TEST(KMeans, thereAreKClustersOrAsManyAsDifferentPoints) {
  EXPECT_TRUE(rc::check("none is empty, and they are numbered from zero", [] {
    const std::vector<Vector2> points = arbitrary_points(30);
    const auto k = *rc::gen::inRange<std::size_t>(1, 6);
    const Labels labels = labels_of(points, k);
    std::set<std::size_t> used;
    for (const auto& [point, label] : labels) used.insert(label);
    RC_ASSERT(used.size() <= std::min(k, labels.size()));
    if (!used.empty()) RC_ASSERT(*used.rbegin() == used.size() - 1);
    if (labels.size() <= k) RC_ASSERT(used.size() == labels.size());
    if (k >= 2 && labels.size() >= 2) RC_ASSERT(used.size() >= 2U);
  }));
}

TEST(KMeans, everyPointIsWithTheNearestMean) {
  EXPECT_TRUE(rc::check("Lloyd's fixed point", [] {
    const std::vector<Vector2> points = arbitrary_points(30);
    const auto k = *rc::gen::inRange<std::size_t>(1, 5);
    const Labels labels = labels_of(points, k);
    std::vector<Vector2> sums(k, Vector2(0.0, 0.0));
    std::vector<double> counts(k, 0.0);
    for (const auto& [point, label] : labels) {
      sums[label] += Vector2(point.first, point.second);
      counts[label] += 1.0;
    }
    for (const auto& [point, label] : labels) {
      const Vector2 p(point.first, point.second);
      for (std::size_t c = 0; c < k; ++c) {
        if (counts[c] == 0.0) continue;
        RC_ASSERT((sums[label] / counts[label] - p).norm() <= (sums[c] / counts[c] - p).norm() + 1e-9);
      }
    }
  }));
}

TEST(KMeans, takesTwoWingsOfABuildingApart) {
  const std::vector<Vector2> points{{1.0, 0.0}, {31.0, 2.0}, {3.0, 1.0}, {29.0, 0.0}, {30.0, -2.0}};
  EXPECT_EQ(k_means(points, 2), (std::vector<std::size_t>{0, 1, 0, 1, 1}));
  EXPECT_EQ(k_means(points, 5), (std::vector<std::size_t>{0, 4, 1, 2, 3})) << "numbered from the left";
  EXPECT_TRUE(k_means({}, 3).empty());
}

}  // namespace
}  // namespace topo::team

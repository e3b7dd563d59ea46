// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/k_means.hpp"

#include <algorithm>
#include <cmath>

namespace topo::team {
namespace {

using types::Vector2;
using Points = std::vector<Vector2>;

constexpr int kRoundsMax = 50;  // the rounds end by themselves; the bound holds if rounding prevents that

Vector2 mean_of(const Points& points) {
  Vector2 sum(0.0, 0.0);
  for (const Vector2& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// The first of the greatest distances.
std::size_t farthest(const std::vector<double>& away_m2) {
  return static_cast<std::size_t>(std::max_element(away_m2.begin(), away_m2.end()) - away_m2.begin());
}

Points farthest_points(const Points& points, std::size_t k) {
  std::vector<double> away_m2;
  const Vector2 mean = mean_of(points);
  for (const Vector2& p : points) away_m2.push_back((p - mean).squaredNorm());
  Points chosen{points[farthest(away_m2)]};
  std::fill(away_m2.begin(), away_m2.end(), HUGE_VAL);
  while (chosen.size() < k) {
    for (std::size_t i = 0; i < points.size(); ++i)
      away_m2[i] = std::min(away_m2[i], (points[i] - chosen.back()).squaredNorm());
    chosen.push_back(points[farthest(away_m2)]);
  }
  return chosen;
}

std::size_t nearest(const Points& centres, const Vector2& p) {
  const auto nearer = [&](const Vector2& a, const Vector2& b) {
    return (a - p).squaredNorm() < (b - p).squaredNorm();
  };
  return static_cast<std::size_t>(std::min_element(centres.begin(), centres.end(), nearer) - centres.begin());
}

/// Moves each centre to the mean of its points; a centre without points stays where it is.
void recentre(const Points& points, const std::vector<std::size_t>& cluster, Points& centres) {
  Points sums(centres.size(), Vector2(0.0, 0.0));
  std::vector<std::size_t> counts(centres.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sums[cluster[i]] += points[i];
    ++counts[cluster[i]];
  }
  for (std::size_t c = 0; c < centres.size(); ++c) {
    if (counts[c] > 0) centres[c] = sums[c] / static_cast<double>(counts[c]);
  }
}

/// Renumbers the clusters in the order of their first points; clusters without points get no number.
void number_by_first(std::vector<std::size_t>& cluster) {
  std::vector<std::size_t> met;
  for (std::size_t& c : cluster) {
    const auto at = std::find(met.begin(), met.end(), c);
    const auto number = static_cast<std::size_t>(at - met.begin());
    if (at == met.end()) met.push_back(c);
    c = number;
  }
}

std::vector<std::size_t> clusters_of_sorted(const Points& points, std::size_t k) {
  std::vector<std::size_t> cluster(points.size());
  if (points.size() <= k) {
    for (std::size_t i = 0; i < points.size(); ++i) cluster[i] = i;
    return cluster;
  }
  Points centres = farthest_points(points, k);
  for (int round = 0; round < kRoundsMax; ++round) {
    bool changed = round == 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t now = nearest(centres, points[i]);
      changed = changed || now != cluster[i];
      cluster[i] = now;
    }
    if (!changed) break;
    recentre(points, cluster, centres);
  }
  number_by_first(cluster);
  return cluster;
}

}  // namespace

bool comes_before(const Vector2& a, const Vector2& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

std::vector<std::size_t> k_means(std::span<const Vector2> points, std::size_t k) {
  Points sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(), comes_before);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  const std::vector<std::size_t> of_sorted = clusters_of_sorted(sorted, k);
  std::vector<std::size_t> cluster;
  for (const Vector2& p : points) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), p, comes_before);
    cluster.push_back(of_sorted[static_cast<std::size_t>(at - sorted.begin())]);
  }
  return cluster;
}

}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>

#include "core/slam/keyframe.hpp"

namespace topo::slam::testing {

/// A keyframe of random content: a walk of hits, of which some are match points.
inline Keyframe random_keyframe(std::uint32_t sequence, std::size_t hits, std::mt19937& random) {
  std::uniform_real_distribution<float> step(-0.2F, 0.2F), place(-30.0F, 30.0F);
  Keyframe k;
  k.id = {3, sequence};
  k.stamp = types::stamp_from_seconds(100.0 + 0.5 * sequence);
  k.T_odom_base = {static_cast<double>(place(random)), static_cast<double>(place(random)), 1.25};
  k.sensor = Point(0.021F, 0.0F);
  Point at(place(random), place(random));
  for (std::size_t i = 0; i < hits; ++i) {
    at += Point(step(random), step(random));
    k.hits.push_back(at);
    if (i % 3 == 0) k.match_points.push_back(at);
    const float angle = place(random);
    if (i % 2 == 0)
      k.surfels.push_back({at + Point(0.01F, 0.0F), Point(std::cos(angle), std::sin(angle)), i % 4 == 0});
    if (i % 5 == 0) k.columns.push_back({at.x(), at.y(), static_cast<walls::Slabs>(random())});
  }
  return k;
}

inline bool same(const Surfel& a, const Surfel& b) {
  return a.position == b.position && a.normal == b.normal && a.planar == b.planar;
}
inline bool same(const walls::ColumnPoint& a, const walls::ColumnPoint& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.slabs == b.slabs;
}
/// Equal to the bit in everything.
inline bool same(const Keyframe& a, const Keyframe& b) {
  const auto equal = [](const auto& x, const auto& y) { return same(x, y); };
  return a.id == b.id && a.stamp == b.stamp && a.T_odom_base == b.T_odom_base && a.sensor == b.sensor &&
         a.hits == b.hits && a.match_points == b.match_points &&
         std::equal(a.surfels.begin(), a.surfels.end(), b.surfels.begin(), b.surfels.end(), equal) &&
         std::equal(a.columns.begin(), a.columns.end(), b.columns.begin(), b.columns.end(), equal);
}

}  // namespace topo::slam::testing

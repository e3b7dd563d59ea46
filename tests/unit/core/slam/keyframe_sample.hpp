// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>

#include "core/slam/keyframe.hpp"

namespace topo::slam::testing {

/// A walk of hits, of which some are match points.
inline KeyframeContent random_content(std::size_t hits, std::mt19937& random) {
  std::uniform_real_distribution<float> step(-0.2F, 0.2F), place(-30.0F, 30.0F);
  KeyframeContent content;
  Point at(place(random), place(random));
  for (std::size_t i = 0; i < hits; ++i) {
    at += Point(step(random), step(random));
    content.hits.push_back(at);
    if (i % 3 == 0) content.match_points.push_back(at);
    const float angle = place(random);
    if (i % 2 == 0)
      content.surfels.push_back(
          {at + Point(0.01F, 0.0F), Point(std::cos(angle), std::sin(angle)), i % 4 == 0});
    if (i % 5 == 0) content.columns.push_back({at.x(), at.y(), static_cast<walls::Slabs>(random())});
  }
  return content;
}

inline KeyframeContent decoded(const CodedContent& coded) {
  return {coded.hits(), coded.surfels(), coded.match_points(), coded.columns()};
}

inline Keyframe random_keyframe(std::uint32_t sequence, std::size_t hits, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-30.0F, 30.0F);
  Keyframe k;
  k.id = {3, sequence};
  k.stamp = types::stamp_from_seconds(100.0 + 0.5 * sequence);
  k.T_odom_base = {static_cast<double>(place(random)), static_cast<double>(place(random)), 1.25};
  k.sensor = Point(0.021F, 0.0F);
  k.content = CodedContent(random_content(hits, random));
  return k;
}

/// Equal to the bit in everything.
inline bool same(const Keyframe& a, const Keyframe& b) {
  return a.id == b.id && a.stamp == b.stamp && a.T_odom_base == b.T_odom_base && a.sensor == b.sensor &&
         a.content == b.content;
}

}  // namespace topo::slam::testing

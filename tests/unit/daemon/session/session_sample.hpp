// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "core/slam/session.hpp"
#include "tests/unit/core/slam/keyframe_sample.hpp"

namespace topo::daemon::testing {

/// Adds keyframes with poses, an edge from each to the one before, and now and then a closure.
inline void grow(slam::Session& session, std::size_t keyframes, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-20.0, 20.0);
  for (std::size_t i = 0; i < keyframes; ++i) {
    const std::size_t node = session.keyframes.size();
    slam::Keyframe k = slam::testing::random_keyframe(static_cast<std::uint32_t>(node), 30, random);
    session.keyframes.push_back(std::make_shared<const slam::Keyframe>(std::move(k)));
    session.poses.push_back({any(random), any(random), 0.1 * any(random)});
    for (const std::size_t back : {std::size_t{1}, std::size_t{7}}) {
      if (node < back || (back > 1 && node % 3 != 0)) continue;
      slam::Edge edge{node - back, node, {any(random), any(random), 0.1}, Eigen::Matrix3d::Zero(), back > 1};
      for (int r = 0; r < 3; ++r) {
        for (int c = r; c < 3; ++c) edge.information(r, c) = edge.information(c, r) = any(random);
      }
      // Of three finders, one of whom nobody knows.
      const auto finder = static_cast<std::uint16_t>(random() % 3);
      edge.finder = {finder, static_cast<std::uint32_t>(random()), finder * 0x9000'0001U};
      session.edges.push_back(edge);
    }
  }
}

inline slam::Session sample_session(std::size_t keyframes, unsigned seed) {
  std::mt19937 random(seed);
  slam::Session session;
  grow(session, keyframes, random);
  return session;
}

/// Where the robot of drive_on() is at keyframe number `i`: on a circle, once round in 25 keyframes.
inline types::Se2 on_circle(std::size_t i) {
  const double angle = 2.0 * M_PI * static_cast<double>(i) / 25.0;
  return {3.0 * std::cos(angle), 3.0 * std::sin(angle), types::wrap_angle(angle)};
}

/// Adds keyframes whose poses, edges and odometry agree with each other: an edge to the one before, and a
/// closure to the round before.
inline void drive_on(slam::Session& session, std::size_t keyframes, std::mt19937& random) {
  for (std::size_t i = 0; i < keyframes; ++i) {
    const std::size_t node = session.keyframes.size();
    slam::Keyframe k = slam::testing::random_keyframe(static_cast<std::uint32_t>(node), 30, random);
    k.T_odom_base = on_circle(node);  // odometry that contradicts a weak edge is believed
    session.keyframes.push_back(std::make_shared<const slam::Keyframe>(std::move(k)));
    session.poses.push_back(on_circle(node));
    for (const std::size_t back : {std::size_t{1}, std::size_t{25}}) {
      if (node < back) continue;
      slam::Edge edge{node - back, node, on_circle(node - back).inverse() * on_circle(node)};
      edge.information = Eigen::Vector3d(400.0, 400.0, 4e4).asDiagonal();
      edge.robust = back > 1;
      session.edges.push_back(edge);
    }
  }
}

inline bool same(const slam::Edge& a, const slam::Edge& b) {
  return a.from == b.from && a.to == b.to && a.robust == b.robust && a.T_from_to == b.T_from_to &&
         a.information == b.information && a.finder == b.finder;
}

inline bool same_keyframes(const slam::Session& a, const slam::Session& b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!slam::testing::same(*a.keyframes[i], *b.keyframes[i])) return false;
  }
  return true;
}

/// Equal to the bit in everything.
inline bool same(const slam::Session& a, const slam::Session& b) {
  return a.keyframes.size() == b.keyframes.size() && same_keyframes(a, b, a.keyframes.size()) &&
         a.poses == b.poses &&
         std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(),
                    [](const auto& x, const auto& y) { return same(x, y); });
}

}  // namespace topo::daemon::testing

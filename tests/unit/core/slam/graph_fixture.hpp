// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "core/slam/pose_graph.hpp"

namespace topo::slam::testing {

/// A pose within 20 m of the origin along either axis.
inline types::Se2 random_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-20.0, 20.0), heading(-3.1, 3.1);
  const double x_m = place(random), y_m = place(random);
  return {x_m, y_m, heading(random)};
}

inline std::vector<types::Se2> random_poses(std::size_t count, std::mt19937& random) {
  std::vector<types::Se2> poses;
  while (poses.size() < count) poses.push_back(random_pose(random));
  return poses;
}

using NodePairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Pairs of different nodes: those of a random tree over all nodes, and `more` others; either node of a pair
/// may come first.
inline NodePairs random_ties(std::size_t nodes, std::size_t more, std::mt19937& random) {
  NodePairs ties;
  const auto tie = [&](std::size_t a, std::size_t b) {
    ties.push_back(random() % 2 == 0 ? std::pair(a, b) : std::pair(b, a));
  };
  for (std::size_t node = 1; node < nodes; ++node) tie(node, random() % node);
  for (std::size_t k = 0; k < more && nodes > 1; ++k) {
    const std::size_t a = random() % nodes;
    tie(a, (a + 1 + random() % (nodes - 1)) % nodes);
  }
  return ties;
}

/// A symmetric matrix with eigenvalues of at least `least`.
template <int N>
Eigen::Matrix<double, N, N> random_positive(double least, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::Matrix<double, N, N> root =
      Eigen::Matrix<double, N, N>::NullaryExpr([&] { return normal(random); });
  return root * root.transpose() + least * Eigen::Matrix<double, N, N>::Identity();
}

/// An edge that measures the poses, and errs by `error`.
inline Edge measured(std::span<const types::Se2> poses, std::size_t from, std::size_t to,
                     const types::Se2& error = {}) {
  Edge edge;
  edge.from = from;
  edge.to = to;
  edge.T_from_to = poses[from].inverse() * poses[to] * error;
  return edge;
}

/// Edges between these pairs of nodes with random errors and information.
inline std::vector<Edge> measured_ties(std::span<const types::Se2> poses, const NodePairs& ties, double error,
                                       std::mt19937& random) {
  std::normal_distribution<double> unit;
  const auto normal = [&](std::mt19937& from) { return error * unit(from); };  // error may be 0
  std::vector<Edge> edges;
  for (const auto& [from, to] : ties) {
    const double x_m = normal(random), y_m = normal(random), theta_rad = normal(random);
    edges.push_back(measured(poses, from, to, {x_m, y_m, theta_rad}));
    edges.back().information = random_positive<3>(1.0, random);
  }
  return edges;
}

/// Greatest difference of two poses: metres or radians.
inline double difference(const types::Se2& a, const types::Se2& b) {
  return std::max(distance_m(a, b), std::abs(types::wrap_angle(a.theta_rad - b.theta_rad)));
}

inline double greatest_difference(std::span<const types::Se2> a, std::span<const types::Se2> b) {
  if (a.size() != b.size()) return HUGE_VAL;
  double greatest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, difference(a[i], b[i]));
  return greatest;
}

inline std::vector<types::Se2> moved(const types::Se2& by, std::span<const types::Se2> poses) {
  std::vector<types::Se2> result;
  for (const types::Se2& pose : poses) result.push_back(by * pose);
  return result;
}

}  // namespace topo::slam::testing

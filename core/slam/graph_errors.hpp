// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// The errors of a graph's edges at one set of poses.
struct GraphErrors {
  struct Direction {
    double cos = 1.0, sin = 0.0;
  };
  struct AtEdge {
    Eigen::Vector2d between;  ///< from node `from` to node `to`, in the axes of `from`
    Eigen::Vector3d error;    ///< as returned by edge_error
    double chi2 = 0.0;
  };
  std::vector<Direction> headings;  ///< of the nodes
  std::vector<AtEdge> edges;
  double chi2 = 0.0;  ///< sum over the edges
  double loss = 0.0;  ///< the same, with the robust losses
};

/// An edge's linearised error and its weight (Triggs et al. 2000, section 4.3: a robust loss as a weight).
struct LinearError {
  Eigen::Vector3d error;
  Eigen::Matrix3d from, to;  ///< Jacobians with respect to (x, y, theta) of the nodes
  Eigen::Matrix3d weight;
};

/// Evaluates a graph repeatedly: terms that do not depend on the poses are computed once, sines and cosines
/// once per node instead of once per edge.
class GraphErrorModel {
 public:
  /// The edges must outlive the model. `kernel`: Cauchy scale of closures and doubted matches, in standard
  /// deviations.
  GraphErrorModel(std::span<const Edge> edges, double kernel);

  /// Evaluates at these poses; reuses the memory of `out`.
  void evaluate(std::span<const types::Se2> poses, GraphErrors& out) const;

  [[nodiscard]] LinearError linearise(std::size_t edge, const GraphErrors& errors) const;

 private:
  std::span<const Edge> edges_;
  double kernel2_;
  std::vector<GraphErrors::Direction> measured_;  ///< direction of the measured rotation of each edge
};

}  // namespace topo::slam

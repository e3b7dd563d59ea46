// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/slam/keyframe_id.hpp"
#include "core/slam/params.hpp"

namespace topo::slam {

/// Measured pose of node `to` in the frame of node `from`. The information is in the axes of the measured
/// `to`.
struct Edge {
  std::size_t from = 0;
  std::size_t to = 0;
  types::Se2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  bool robust = false;  ///< a closure: Cauchy loss instead of squares
  /// Who found it, and its number there, as FoundRelation::id. With run 0 nobody knows: a file of before has
  /// no finders, and a bridge over damage has none. No solution depends on it.
  KeyframeId finder{};
  /// Of a match that odometry contradicts (odometry_evidence.hpp): odometry's squared error by this edge;
  /// such a match has a Cauchy loss, too. 0: not doubted. Follows from the keyframes, set only while a graph
  /// is solved.
  double doubt_chi2 = 0.0;
};

/// True of an edge with Cauchy loss, which the solution may leave out.
[[nodiscard]] inline bool may_be_overruled(const Edge& edge) { return edge.robust || edge.doubt_chi2 > 0.0; }

struct SolveReport {
  double chi2_start = 0.0;  ///< sum of squared whitened errors, without the robust loss
  double chi2_end = 0.0;
  double loss_end = 0.0;  ///< as chi2_end, with the robust losses: what the solution minimises
  int iterations = 0;     ///< linear systems solved
  bool solved = false;    ///< false: the system was singular or a step not finite; poses are unchanged
};

/// Error of an edge: Z^-1 (Xi^-1 Xj) as (x, y, theta).
Eigen::Vector3d edge_error(const Edge& edge, const types::Se2& from, const types::Se2& to);

/// Squared whitened error of an edge.
double edge_chi2(const Edge& edge, std::span<const types::Se2> poses);

/// Sum of the edges' squared whitened errors.
double total_chi2(std::span<const types::Se2> poses, std::span<const Edge> edges);

/// Least squares over SE(2) with node `fixed` held: Levenberg-Marquardt with analytic Jacobians on the sparse
/// normal equations (Kuemmerle et al. 2011; step control after Nielsen 1999). Nodes that no chain of edges
/// connects to `fixed` make the system singular. Pure function of its input; one thread.
SolveReport solve(std::vector<types::Se2>& poses, std::span<const Edge> edges, const GraphParams& params,
                  std::size_t fixed = 0);

/// The same with several nodes held at their poses; there must be one at least.
SolveReport solve(std::vector<types::Se2>& poses, std::span<const Edge> edges, const GraphParams& params,
                  std::span<const std::size_t> fixed);

/// Solves, then solves again without the edges that contradict the rest: closures and doubted matches whose
/// error in the first solution exceeds `params.contradicted_chi2`. The selection depends only on the graph,
/// not on when each closure was found. When the remaining graph is not connected, the first solution is kept.
/// With doubted matches, the first solution is the better of two: from the poses as they are, where a false
/// match bends the whole way rather than itself, and from those to which closures draw it when doubted
/// matches are no nearer to themselves than to odometry (graduated non-convexity, Yang et al. 2020).
SolveReport solve_consistently(std::vector<types::Se2>& poses, std::span<const Edge> edges,
                               const GraphParams& params, std::size_t fixed = 0);

}  // namespace topo::slam

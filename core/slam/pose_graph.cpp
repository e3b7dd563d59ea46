// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/pose_graph.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cmath>

namespace topo::slam {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

struct Linearised {
  Eigen::Vector3d error;
  Eigen::Matrix3d from, to;  ///< Jacobians with respect to (x, y, theta) of the nodes
};

Linearised linearise(const Edge& edge, const types::Se2& a, const types::Se2& b) {
  Linearised out;
  out.error = edge_error(edge, a, b);
  const double phi = a.theta_rad + edge.T_from_to.theta_rad;
  const double c = std::cos(phi), s = std::sin(phi);
  const double ca = std::cos(a.theta_rad), sa = std::sin(a.theta_rad);
  const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m;
  // d(Ra^T d)/d theta, turned into the axes of the measured `to`.
  const double ux = -sa * dx + ca * dy, uy = -ca * dx - sa * dy;
  const double cz = std::cos(edge.T_from_to.theta_rad), sz = std::sin(edge.T_from_to.theta_rad);
  out.from << -c, -s, cz * ux + sz * uy,  //
      s, -c, -sz * ux + cz * uy,          //
      0.0, 0.0, -1.0;
  out.to << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  return out;
}

double loss(double chi2, bool robust, double kernel) {
  return robust ? kernel * kernel * std::log1p(chi2 / (kernel * kernel)) : chi2;
}

double total_loss(const std::vector<types::Se2>& poses, std::span<const Edge> edges,
                  const GraphParams& params) {
  double sum = 0.0;
  for (const Edge& edge : edges) {
    const Eigen::Vector3d e = edge_error(edge, poses[edge.from], poses[edge.to]);
    sum += loss(e.dot(edge.information * e), edge.robust, params.loop_kernel);
  }
  return sum;
}

double total_chi2(const std::vector<types::Se2>& poses, std::span<const Edge> edges) {
  double sum = 0.0;
  for (const Edge& edge : edges) {
    const Eigen::Vector3d e = edge_error(edge, poses[edge.from], poses[edge.to]);
    sum += e.dot(edge.information * e);
  }
  return sum;
}

/// Adds a 3x3 block between nodes (1-based: node 0 is fixed) to the lower triangle.
void add_block(std::vector<Eigen::Triplet<double>>& triplets, std::size_t row, std::size_t column,
               const Eigen::Matrix3d& block) {
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      const int i = static_cast<int>(3 * (row - 1)) + r, j = static_cast<int>(3 * (column - 1)) + c;
      if (i >= j) triplets.emplace_back(i, j, block(r, c));
    }
  }
}

void build(const std::vector<types::Se2>& poses, std::span<const Edge> edges, const GraphParams& params,
           Sparse& h, Eigen::VectorXd& g) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(edges.size() * 27);
  g.setZero();
  for (const Edge& edge : edges) {
    const Linearised lin = linearise(edge, poses[edge.from], poses[edge.to]);
    Eigen::Matrix3d weight = edge.information;
    if (edge.robust) {
      const double k2 = params.loop_kernel * params.loop_kernel;
      weight /= 1.0 + lin.error.dot(edge.information * lin.error) / k2;
    }
    const Eigen::Matrix3d wf = weight * lin.from, wt = weight * lin.to;
    if (edge.from > 0) {
      add_block(triplets, edge.from, edge.from, lin.from.transpose() * wf);
      g.segment<3>(static_cast<Eigen::Index>(3 * (edge.from - 1))) +=
          lin.from.transpose() * (weight * lin.error);
    }
    if (edge.to > 0) {
      add_block(triplets, edge.to, edge.to, lin.to.transpose() * wt);
      g.segment<3>(static_cast<Eigen::Index>(3 * (edge.to - 1))) += lin.to.transpose() * (weight * lin.error);
    }
    if (edge.from > 0 && edge.to > 0) {
      if (edge.from > edge.to)
        add_block(triplets, edge.from, edge.to, lin.from.transpose() * wt);
      else
        add_block(triplets, edge.to, edge.from, lin.to.transpose() * wf);
    }
  }
  h.setFromTriplets(triplets.begin(), triplets.end());
}

std::vector<types::Se2> moved(const std::vector<types::Se2>& poses, const Eigen::VectorXd& step) {
  std::vector<types::Se2> out = poses;
  for (std::size_t i = 1; i < out.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(3 * (i - 1));
    out[i] = {out[i].x_m + step[k], out[i].y_m + step[k + 1],
              types::wrap_angle(out[i].theta_rad + step[k + 2])};
  }
  return out;
}

}  // namespace

Eigen::Vector3d edge_error(const Edge& edge, const types::Se2& from, const types::Se2& to) {
  const types::Se2 e = edge.T_from_to.inverse() * (from.inverse() * to);
  return {e.x_m, e.y_m, e.theta_rad};
}

SolveReport solve(std::vector<types::Se2>& poses, std::span<const Edge> edges, const GraphParams& params) {
  SolveReport report;
  report.chi2_start = report.chi2_end = total_chi2(poses, edges);
  if (poses.size() < 2) {
    report.solved = true;
    return report;
  }
  const auto size = static_cast<Eigen::Index>(3 * (poses.size() - 1));
  Sparse h(size, size);
  Eigen::VectorXd g(size);
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> factor;
  double damping = 0.0;
  double current = total_loss(poses, edges, params);
  bool analysed = false;
  for (report.iterations = 0; report.iterations < params.iterations_max; ++report.iterations) {
    build(poses, edges, params, h, g);
    if (damping > 0.0) {
      for (Eigen::Index i = 0; i < size; ++i) h.coeffRef(i, i) *= 1.0 + damping;
    }
    if (!analysed) factor.analyzePattern(h);
    analysed = true;
    factor.factorize(h);
    if (factor.info() != Eigen::Success) return report;
    const Eigen::VectorXd step = factor.solve(-g);
    if (!step.allFinite()) return report;
    std::vector<types::Se2> candidate = moved(poses, step);
    const double next = total_loss(candidate, edges, params);
    if (next > current) {
      damping = damping == 0.0 ? 1e-4 : damping * 10.0;
      if (damping > 1e4) break;
      continue;
    }
    damping *= 0.1;
    poses = std::move(candidate);
    const bool converged = current - next < 1e-6 * (current + 1e-12);
    current = next;
    report.solved = true;
    if (converged) break;
  }
  report.solved = true;
  report.chi2_end = total_chi2(poses, edges);
  return report;
}

}  // namespace topo::slam

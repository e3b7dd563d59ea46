// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_errors.hpp"

#include <cmath>

namespace topo::slam {
namespace {

using Direction = GraphErrors::Direction;

Direction direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

/// A vector in axes rotated by a direction.
Eigen::Vector2d in_axes(const Direction& d, const Eigen::Vector2d& v) {
  return {d.cos * v.x() + d.sin * v.y(), -d.sin * v.x() + d.cos * v.y()};
}

}  // namespace

GraphErrorModel::GraphErrorModel(std::span<const Edge> edges, double kernel)
    : edges_(edges), kernel2_(kernel * kernel) {
  measured_.reserve(edges.size());
  for (const Edge& edge : edges) measured_.push_back(direction(edge.T_from_to.theta_rad));
}

void GraphErrorModel::evaluate(std::span<const types::Se2> poses, GraphErrors& out) const {
  out.headings.resize(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) out.headings[i] = direction(poses[i].theta_rad);
  out.edges.resize(edges_.size());
  out.chi2 = out.loss = 0.0;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Edge& edge = edges_[i];
    const types::Se2 &a = poses[edge.from], &b = poses[edge.to];
    GraphErrors::AtEdge& at = out.edges[i];
    at.between = in_axes(out.headings[edge.from], b.translation() - a.translation());
    at.error << in_axes(measured_[i], at.between - edge.T_from_to.translation()),
        types::wrap_angle(types::wrap_angle(b.theta_rad - a.theta_rad) - edge.T_from_to.theta_rad);
    at.chi2 = at.error.dot(edge.information * at.error);
    out.chi2 += at.chi2;
    out.loss += may_be_overruled(edge) ? kernel2_ * std::log1p(at.chi2 / kernel2_) : at.chi2;
  }
}

LinearError GraphErrorModel::linearise(std::size_t edge, const GraphErrors& errors) const {
  const GraphErrors::AtEdge& at = errors.edges[edge];
  const Direction &a = errors.headings[edges_[edge].from], &z = measured_[edge];
  const double c = a.cos * z.cos - a.sin * z.sin, s = a.sin * z.cos + a.cos * z.sin;
  // d(Ra^T d)/d theta, rotated into the axes of the measured `to`.
  const Eigen::Vector2d turned = in_axes(z, {at.between.y(), -at.between.x()});
  LinearError out;
  out.error = at.error;
  out.from << -c, -s, turned.x(),  //
      s, -c, turned.y(),           //
      0.0, 0.0, -1.0;
  out.to << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  out.weight = edges_[edge].information;
  if (may_be_overruled(edges_[edge])) out.weight /= 1.0 + at.chi2 / kernel2_;
  return out;
}

}  // namespace topo::slam

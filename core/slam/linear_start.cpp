// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/linear_start.hpp"

#include <cmath>

#include "core/slam/block_factor.hpp"
#include "core/slam/graph_pattern.hpp"

namespace topo::slam {
namespace {

using Matrix = Eigen::Matrix2d;
using Vector = Eigen::Vector2d;

Matrix rotation(double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return (Matrix() << c, -s, s, c).finished();
}

/// Linear least squares over one vector per node, with the residual x_to - M x_from - d of weight W.
class NodeSystem {
 public:
  explicit NodeSystem(const GraphPattern& pattern)
      : factor_(pattern.elimination()), rhs_(pattern.elimination().variables(), Vector::Zero()) {}

  /// `from` and `to`: the nodes' values, used of those that are fixed.
  void add(const GraphPattern::EdgePlaces& places, const Matrix& m, const Vector& d, const Matrix& weight,
           const Vector& from, const Vector& to) {
    Vector known = d;
    if (!places.has_from) known += m * from;
    if (!places.has_to) known -= to;
    const Matrix mw = m.transpose() * weight;
    if (places.has_from) {
      factor_.add(places.from, mw * m);
      rhs_[places.from_variable] -= mw * known;
    }
    if (places.has_to) {
      factor_.add(places.to, weight);
      rhs_[places.to_variable] += weight * known;
    }
    if (places.has_from && places.has_to) factor_.add(places.between, -mw);
  }

  /// The solution in the order of the variables; false when singular.
  bool solve() {
    if (!factor_.factorise()) return false;
    factor_.solve(rhs_);
    return true;
  }
  [[nodiscard]] const std::vector<Vector>& solution() const { return rhs_; }

 private:
  BlockFactor<2> factor_;
  std::vector<Vector> rhs_;
};

Vector direction(const types::Se2& pose) { return {std::cos(pose.theta_rad), std::sin(pose.theta_rad)}; }

bool start_headings(std::vector<types::Se2>& poses, std::span<const Edge> edges,
                    const GraphPattern& pattern) {
  NodeSystem system(pattern);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    system.add(pattern.links()[i], rotation(edges[i].T_from_to.theta_rad), Vector::Zero(),
               edges[i].information(2, 2) * Matrix::Identity(), direction(poses[edges[i].from]),
               direction(poses[edges[i].to]));
  }
  if (!system.solve()) return false;
  for (std::size_t v = 0; v < system.solution().size(); ++v) {
    const Vector& z = system.solution()[v];
    poses[pattern.node(v)].theta_rad = std::atan2(z.y(), z.x());
  }
  return true;
}

bool start_positions(std::vector<types::Se2>& poses, std::span<const Edge> edges,
                     const GraphPattern& pattern) {
  NodeSystem system(pattern);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Edge& edge = edges[i];
    const Matrix axes = rotation(poses[edge.from].theta_rad);
    const Matrix to_axes = axes * rotation(edge.T_from_to.theta_rad);
    const Matrix weight = to_axes * edge.information.topLeftCorner<2, 2>() * to_axes.transpose();
    system.add(pattern.links()[i], Matrix::Identity(), axes * edge.T_from_to.translation(), weight,
               poses[edge.from].translation(), poses[edge.to].translation());
  }
  if (!system.solve()) return false;
  for (std::size_t v = 0; v < system.solution().size(); ++v) {
    poses[pattern.node(v)].x_m = system.solution()[v].x();
    poses[pattern.node(v)].y_m = system.solution()[v].y();
  }
  return true;
}

}  // namespace

bool start_linearly(std::vector<types::Se2>& poses, std::span<const Edge> edges, std::size_t fixed) {
  return start_linearly(poses, edges, std::span<const std::size_t>(&fixed, 1));
}

bool start_linearly(std::vector<types::Se2>& poses, std::span<const Edge> edges,
                    std::span<const std::size_t> fixed) {
  if (poses.size() <= fixed.size()) return true;
  if (!is_connected(poses.size(), edges, fixed)) return false;
  const GraphPattern pattern(poses.size(), edges, fixed);
  std::vector<types::Se2> start = poses;
  if (!start_headings(start, edges, pattern) || !start_positions(start, edges, pattern)) return false;
  poses = std::move(start);
  return true;
}

}  // namespace topo::slam

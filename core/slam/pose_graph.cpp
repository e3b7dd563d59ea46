// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/pose_graph.hpp"

#include <algorithm>
#include <cmath>

#include "core/slam/block_factor.hpp"
#include "core/slam/graph_pattern.hpp"

namespace topo::slam {
namespace {

using Factor = BlockFactor<3>;

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

double total_loss(std::span<const types::Se2> poses, std::span<const Edge> edges, const GraphParams& params) {
  double sum = 0.0;
  for (const Edge& edge : edges) sum += loss(edge_chi2(edge, poses), edge.robust, params.loop_kernel);
  return sum;
}

class Solver {
 public:
  Solver(std::vector<types::Se2>& poses, std::span<const Edge> edges, const GraphParams& params,
         std::size_t fixed)
      : poses_(poses),
        edges_(edges),
        params_(params),
        pattern_(poses.size(), edges, fixed),
        factor_(pattern_.elimination()),
        gradient_(pattern_.elimination().variables()),
        step_(gradient_.size()),
        diagonal_(gradient_.size()) {}

  /// Iterates; false when the system is singular at the start.
  bool run(int& iterations) {
    current_ = total_loss(poses_, edges_, params_);
    for (iterations = 0; iterations < params_.iterations_max;) {
      build();
      ++iterations;
      while (!try_step()) {
        if (!std::isfinite(current_) || damping_ > kDampingMax) return moved_;
        if (iterations == params_.iterations_max) return moved_;
        ++iterations;
        build();
      }
      moved_ = true;
      if (largest_step() < params_.converged) break;
    }
    return true;
  }

 private:
  static constexpr double kDampingMin = 1e-7;  ///< below: a plain Gauss-Newton step
  static constexpr double kDampingMax = 1e8;

  void build() {
    factor_.set_zero();
    std::fill(gradient_.begin(), gradient_.end(), Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < edges_.size(); ++i) add(edges_[i], pattern_.links()[i]);
    std::size_t at = 0;
    factor_.add_to_diagonal([&](double entry) {
      diagonal_[at / 3][static_cast<Eigen::Index>(at % 3)] = entry;
      ++at;
      return damping_ * entry;
    });
  }

  void add(const Edge& edge, const GraphPattern::EdgePlaces& places) {
    const Linearised lin = linearise(edge, poses_[edge.from], poses_[edge.to]);
    Eigen::Matrix3d weight = edge.information;
    if (edge.robust)
      weight /=
          1.0 + lin.error.dot(edge.information * lin.error) / (params_.loop_kernel * params_.loop_kernel);
    const Eigen::Matrix3d wf = weight * lin.from, wt = weight * lin.to;
    const Eigen::Vector3d we = weight * lin.error;
    if (places.has_from) {
      factor_.add(places.from, lin.from.transpose() * wf);
      gradient_[places.from_variable] += lin.from.transpose() * we;
    }
    if (places.has_to) {
      factor_.add(places.to, lin.to.transpose() * wt);
      gradient_[places.to_variable] += lin.to.transpose() * we;
    }
    if (places.has_from && places.has_to) factor_.add(places.between, lin.from.transpose() * wt);
  }

  /// One damped step; false when it was refused, and then the damping is greater than before.
  bool try_step() {
    if (!factor_.factorise()) return refuse();
    for (std::size_t i = 0; i < gradient_.size(); ++i) step_[i] = -gradient_[i];
    factor_.solve(step_);
    const std::vector<types::Se2> candidate = moved();
    const double next = total_loss(candidate, edges_, params_);
    if (!std::isfinite(next) || next > current_ * (1.0 + kRounding)) return refuse();
    const double predicted = predicted_decrease();
    const double gain = predicted > 0.0 ? (current_ - next) / predicted : 1.0;
    damping_ *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3.0));
    if (damping_ < kDampingMin) damping_ = 0.0;
    growth_ = 2.0;
    poses_ = candidate;
    current_ = next;
    return true;
  }

  bool refuse() {
    damping_ = std::max(damping_, 0.5 * kDampingMin * 1e3) * growth_;
    growth_ *= 2.0;
    return false;
  }

  /// Of the quadratic model: -(2 g + H s) s with (H + damping D) s = -g.
  [[nodiscard]] double predicted_decrease() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < step_.size(); ++i) {
      const std::size_t rank = pattern_.elimination().rank(i);
      sum += step_[i].dot(damping_ * diagonal_[rank].cwiseProduct(step_[i]) - gradient_[i]);
    }
    return sum;
  }

  [[nodiscard]] std::vector<types::Se2> moved() const {
    std::vector<types::Se2> out = poses_;
    for (std::size_t i = 0; i < step_.size(); ++i) {
      types::Se2& pose = out[pattern_.node(i)];
      pose = {pose.x_m + step_[i].x(), pose.y_m + step_[i].y(),
              types::wrap_angle(pose.theta_rad + step_[i].z())};
    }
    return out;
  }

  [[nodiscard]] double largest_step() const {
    double largest = 0.0;
    for (const Eigen::Vector3d& step : step_) largest = std::max(largest, step.cwiseAbs().maxCoeff());
    return largest;
  }

  static constexpr double kRounding = 1e-13;  ///< at the optimum sums differ by their rounding

  std::vector<types::Se2>& poses_;
  std::span<const Edge> edges_;
  const GraphParams& params_;
  GraphPattern pattern_;
  Factor factor_;
  std::vector<Eigen::Vector3d> gradient_, step_;
  std::vector<Eigen::Vector3d> diagonal_;  ///< of the undamped matrix, in the order of elimination
  double current_ = 0.0;
  double damping_ = 0.0, growth_ = 2.0;
  bool moved_ = false;
};

}  // namespace

Eigen::Vector3d edge_error(const Edge& edge, const types::Se2& from, const types::Se2& to) {
  const types::Se2 e = edge.T_from_to.inverse() * (from.inverse() * to);
  return {e.x_m, e.y_m, e.theta_rad};
}

double edge_chi2(const Edge& edge, std::span<const types::Se2> poses) {
  const Eigen::Vector3d e = edge_error(edge, poses[edge.from], poses[edge.to]);
  return e.dot(edge.information * e);
}

double total_chi2(std::span<const types::Se2> poses, std::span<const Edge> edges) {
  double sum = 0.0;
  for (const Edge& edge : edges) sum += edge_chi2(edge, poses);
  return sum;
}

SolveReport solve(std::vector<types::Se2>& poses, std::span<const Edge> edges, const GraphParams& params,
                  std::size_t fixed) {
  SolveReport report;
  report.chi2_start = report.chi2_end = total_chi2(poses, edges);
  if (poses.size() < 2) {
    report.solved = true;
    return report;
  }
  if (!is_connected(poses.size(), edges)) return report;
  report.solved = Solver(poses, edges, params, fixed).run(report.iterations);
  report.chi2_end = total_chi2(poses, edges);
  return report;
}

}  // namespace topo::slam

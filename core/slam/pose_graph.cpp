// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/pose_graph.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/slam/block_factor.hpp"
#include "core/slam/graph_errors.hpp"
#include "core/slam/graph_pattern.hpp"

namespace topo::slam {
namespace {

using Factor = BlockFactor<3>;

class Solver {
 public:
  Solver(std::vector<types::Se2>& poses, std::span<const Edge> edges, const GraphParams& params,
         std::span<const std::size_t> fixed)
      : poses_(poses),
        model_(edges, params.loop_kernel),
        params_(params),
        pattern_(poses.size(), edges, fixed),
        factor_(pattern_.elimination()),
        gradient_(pattern_.elimination().variables()),
        step_(gradient_.size()),
        diagonal_(gradient_.size()) {
    model_.evaluate(poses_, errors_);
  }

  [[nodiscard]] double chi2() const { return errors_.chi2; }
  [[nodiscard]] double loss() const { return errors_.loss; }

  /// Iterates; false when no step was accepted (the system is singular or the loss not finite).
  bool run(int& iterations) {
    for (iterations = 0; iterations < params_.iterations_max;) {
      build();
      ++iterations;
      while (!try_step()) {
        if (!std::isfinite(errors_.loss) || damping_ > kDampingMax) return moved_;
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
  static constexpr double kDampingMin = 1e-7;  ///< below it a plain Gauss-Newton step is used
  static constexpr double kDampingMax = 1e8;   ///< above it a step is too short to change the poses

  void build() {
    factor_.set_zero();
    std::fill(gradient_.begin(), gradient_.end(), Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < errors_.edges.size(); ++i)
      add(model_.linearise(i, errors_), pattern_.links()[i]);
    std::size_t at = 0;
    factor_.add_to_diagonal([&](double entry) {
      diagonal_[at / 3][static_cast<Eigen::Index>(at % 3)] = entry;
      ++at;
      return damping_ * entry;
    });
  }

  void add(const LinearError& lin, const GraphPattern::EdgePlaces& places) {
    const Eigen::Matrix3d wf = lin.weight * lin.from, wt = lin.weight * lin.to;
    const Eigen::Vector3d we = lin.weight * lin.error;
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

  /// Tries one damped step; false when it was refused, with the damping increased.
  bool try_step() {
    if (!factor_.factorise()) return refuse();
    for (std::size_t i = 0; i < gradient_.size(); ++i) step_[i] = -gradient_[i];
    factor_.solve(step_);
    move();
    model_.evaluate(next_poses_, next_errors_);
    const double now = errors_.loss, next = next_errors_.loss;
    if (!std::isfinite(next) || next > now * (1.0 + kRounding)) return refuse();
    const double predicted = predicted_decrease();
    const double gain = predicted > 0.0 ? (now - next) / predicted : 1.0;
    damping_ *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3.0));
    if (damping_ < kDampingMin) damping_ = 0.0;
    growth_ = 2.0;
    poses_.swap(next_poses_);
    std::swap(errors_, next_errors_);
    return true;
  }

  bool refuse() {
    damping_ = std::max(damping_, 0.5 * kDampingMin * 1e3) * growth_;
    growth_ *= 2.0;
    return false;
  }

  /// Decrease predicted by the quadratic model: -(2 g + H s) s with (H + damping D) s = -g.
  [[nodiscard]] double predicted_decrease() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < step_.size(); ++i) {
      const std::size_t rank = pattern_.elimination().rank(i);
      sum += step_[i].dot(damping_ * diagonal_[rank].cwiseProduct(step_[i]) - gradient_[i]);
    }
    return sum;
  }

  void move() {
    next_poses_ = poses_;
    for (std::size_t i = 0; i < step_.size(); ++i) {
      types::Se2& pose = next_poses_[pattern_.node(i)];
      pose = {pose.x_m + step_[i].x(), pose.y_m + step_[i].y(),
              types::wrap_angle(pose.theta_rad + step_[i].z())};
    }
  }

  [[nodiscard]] double largest_step() const {
    double largest = 0.0;
    for (const Eigen::Vector3d& step : step_) largest = std::max(largest, step.cwiseAbs().maxCoeff());
    return largest;
  }

  static constexpr double kRounding = 1e-13;  ///< at the optimum the sums differ by rounding errors

  std::vector<types::Se2>& poses_;
  std::vector<types::Se2> next_poses_;
  GraphErrorModel model_;
  GraphErrors errors_, next_errors_;
  const GraphParams& params_;
  GraphPattern pattern_;
  Factor factor_;
  std::vector<Eigen::Vector3d> gradient_, step_;
  std::vector<Eigen::Vector3d> diagonal_;  ///< of the undamped matrix, in the elimination order
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
  return solve(poses, edges, params, std::span<const std::size_t>(&fixed, 1));
}

SolveReport solve(std::vector<types::Se2>& poses, std::span<const Edge> edges, const GraphParams& params,
                  std::span<const std::size_t> fixed) {
  SolveReport report;
  const bool nothing_free = poses.size() <= fixed.size();
  if (nothing_free || !is_connected(poses.size(), edges, fixed)) {
    report.chi2_start = report.chi2_end = total_chi2(poses, edges);
    report.solved = nothing_free;
    return report;
  }
  Solver solver(poses, edges, params, fixed);
  report.chi2_start = solver.chi2();
  report.solved = solver.run(report.iterations);
  report.chi2_end = solver.chi2();
  report.loss_end = solver.loss();
  return report;
}

namespace {

bool is_doubted(const Edge& edge) { return edge.doubt_chi2 > 0.0; }

/// Poses to which closures draw the graph when each doubted match is only as certain as its distance from
/// odometry.
std::vector<types::Se2> drawn_by_closures(std::vector<types::Se2> poses, std::span<const Edge> edges,
                                          const GraphParams& params, std::size_t fixed) {
  std::vector<Edge> loose(edges.begin(), edges.end());
  for (Edge& edge : loose)
    if (is_doubted(edge)) edge.information /= edge.doubt_chi2;
  (void)solve(poses, loose, params, fixed);
  return poses;
}

SolveReport solve_doubting(std::vector<types::Se2>& poses, std::span<const Edge> edges,
                           const GraphParams& params, std::size_t fixed) {
  const bool doubts = std::any_of(edges.begin(), edges.end(), is_doubted);
  std::vector<types::Se2> drawn;
  if (doubts) drawn = drawn_by_closures(poses, edges, params, fixed);
  const SolveReport straight = solve(poses, edges, params, fixed);
  if (!doubts || !straight.solved) return straight;
  SolveReport mended = solve(drawn, edges, params, fixed);
  if (!mended.solved || mended.loss_end >= straight.loss_end) return straight;
  poses = std::move(drawn);
  mended.chi2_start = straight.chi2_start;
  mended.iterations += straight.iterations;
  return mended;
}

}  // namespace

SolveReport solve_consistently(std::vector<types::Se2>& poses, std::span<const Edge> edges,
                               const GraphParams& params, std::size_t fixed) {
  const SolveReport first = solve_doubting(poses, edges, params, fixed);
  if (!first.solved) return first;
  std::vector<Edge> consistent;
  std::copy_if(edges.begin(), edges.end(), std::back_inserter(consistent), [&](const Edge& edge) {
    return !may_be_overruled(edge) || edge_chi2(edge, poses) <= params.contradicted_chi2;
  });
  if (consistent.size() == edges.size()) return first;
  const SolveReport second = solve(poses, consistent, params, fixed);
  const SolveReport& last = second.solved ? second : first;
  return {first.chi2_start, last.chi2_end, last.loss_end, first.iterations + second.iterations, true};
}

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_errors.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace topo::slam {
namespace {

using types::Se2;

constexpr double kKernel = 3.0;

Se2 any_pose() {
  const auto number = [](int range) { return *rc::gen::inRange(-range, range) / 100.0; };
  return {number(2000), number(2000), types::wrap_angle(number(400))};
}

struct TwoNodes {
  std::vector<Se2> poses{any_pose(), any_pose()};
  std::vector<Edge> edges = make_edges();

  [[nodiscard]] GraphErrors errors() const { return errors(poses); }
  [[nodiscard]] GraphErrors errors(std::span<const Se2> at) const {
    GraphErrors out;
    GraphErrorModel(edges, kKernel).evaluate(at, out);
    return out;
  }

 private:
  [[nodiscard]] std::vector<Edge> make_edges() const {
    Edge edge{0, 1, any_pose(), Eigen::Vector3d(4.0, 9.0, 16.0).asDiagonal()};
    Edge closure = edge;
    closure.robust = true;
    return {edge, closure};
  }
};

TEST(GraphErrorModel, SaysWhatTheEdgesSay) {
  EXPECT_TRUE(rc::check("error, chi2 and loss", [] {
    const TwoNodes graph;
    const GraphErrors errors = graph.errors();
    const Eigen::Vector3d expected = edge_error(graph.edges[0], graph.poses[0], graph.poses[1]);
    Eigen::Vector3d off = errors.edges[0].error - expected;
    off.z() = types::wrap_angle(off.z());  // at half a turn either sign is right
    RC_ASSERT(off.norm() < 1e-9);
    const double chi2 = edge_chi2(graph.edges[0], graph.poses);
    RC_ASSERT(std::abs(errors.chi2 - 2.0 * chi2) < 1e-9 * (1.0 + chi2));
    const double robust = kKernel * kKernel * std::log1p(chi2 / (kKernel * kKernel));
    RC_ASSERT(std::abs(errors.loss - chi2 - robust) < 1e-9 * (1.0 + chi2));
  }));
}

TEST(GraphErrorModel, JacobiansAreTheErrorsSlopes) {
  EXPECT_TRUE(rc::check("central differences", [] {
    const TwoNodes graph;
    const GraphErrors errors = graph.errors();
    RC_PRE(std::abs(errors.edges[0].error.z()) < 3.0);  // no wrap within the difference
    const LinearError linear = GraphErrorModel(graph.edges, kKernel).linearise(0, errors);
    constexpr double kStep = 1e-5;
    for (std::size_t node = 0; node < 2; ++node) {
      for (int k = 0; k < 3; ++k) {
        const auto error_at = [&](double step) {
          std::vector<Se2> poses = graph.poses;
          double* const fields[] = {&poses[node].x_m, &poses[node].y_m, &poses[node].theta_rad};
          *fields[k] += step;
          return graph.errors(poses).edges[0].error;
        };
        const Eigen::Vector3d slope = (error_at(kStep) - error_at(-kStep)) / (2.0 * kStep);
        const Eigen::Matrix3d& jacobian = node == 0 ? linear.from : linear.to;
        RC_ASSERT((slope - jacobian.col(k)).norm() < 1e-6);
      }
    }
  }));
}

TEST(GraphErrorModel, AClosureWeighsLessTheWorseItFits) {
  EXPECT_TRUE(rc::check("Cauchy's weight", [] {
    const TwoNodes graph;
    const GraphErrors errors = graph.errors();
    const GraphErrorModel model(graph.edges, kKernel);
    RC_ASSERT(model.linearise(0, errors).weight == graph.edges[0].information);
    const double weight = model.linearise(1, errors).weight(0, 0) / graph.edges[1].information(0, 0);
    RC_ASSERT(std::abs(weight * (1.0 + errors.edges[1].chi2 / (kKernel * kKernel)) - 1.0) < 1e-12);
  }));
}

}  // namespace
}  // namespace topo::slam

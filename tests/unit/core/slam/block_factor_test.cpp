// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/block_factor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

/// A matrix of B x B blocks, once in full and once by its pattern.
template <int B>
class BlockSystem {
 public:
  using Block = typename BlockFactor<B>::Block;
  using Vectors = std::vector<typename BlockFactor<B>::Vector>;

  BlockSystem(std::size_t size, const testing::NodePairs& links)
      : pattern(size, links), factor(pattern), full_(Eigen::MatrixXd::Zero(rows(size), rows(size))) {}

  void add(std::size_t row, std::size_t column, const Block& block) {
    factor.add(pattern.place(row, column), block);
    full_.template block<B, B>(rows(row), rows(column)) += block;
    if (row != column) full_.template block<B, B>(rows(column), rows(row)) += block.transpose();
  }
  /// Random blocks, and so much on the diagonal that the matrix is positive definite.
  void fill(const testing::NodePairs& links, std::mt19937& random) {
    std::normal_distribution<double> normal;
    for (const auto& [a, b] : links) {
      const Block from = Block::NullaryExpr([&] { return normal(random); });
      const Block to = Block::NullaryExpr([&] { return normal(random); });
      add(a, a, from.transpose() * from);
      add(b, b, to.transpose() * to);
      add(a, b, from.transpose() * to);
    }
    for (std::size_t v = 0; v < pattern.variables(); ++v) add(v, v, testing::random_positive<B>(0.5, random));
  }
  void damp(double factor_of_diagonal) {
    factor.add_to_diagonal([&](double entry) { return factor_of_diagonal * entry; });
    full_.diagonal() *= 1.0 + factor_of_diagonal;
  }
  void forget() {
    factor.set_zero();
    full_.setZero();
  }
  [[nodiscard]] Vectors right_side(std::mt19937& random) const {
    std::normal_distribution<double> normal;
    Vectors b(pattern.variables());
    for (auto& part : b) part = BlockFactor<B>::Vector::NullaryExpr([&] { return normal(random); });
    return b;
  }
  [[nodiscard]] double distance_from_full_solution(const Vectors& b, const Vectors& x) const {
    Eigen::VectorXd right(full_.rows()), found(full_.rows());
    for (std::size_t v = 0; v < b.size(); ++v) {
      right.segment<B>(rows(v)) = b[v];
      found.segment<B>(rows(v)) = x[v];
    }
    return (full_.ldlt().solve(right) - found).norm() / (1.0 + found.norm());
  }

  const Elimination pattern;
  BlockFactor<B> factor;

 private:
  static Eigen::Index rows(std::size_t blocks) { return B * static_cast<Eigen::Index>(blocks); }
  Eigen::MatrixXd full_;
};

template <int B>
void expect_solved_as_in_full(unsigned seed) {
  std::mt19937 random(seed);
  const std::size_t size = 1 + random() % 25;
  const testing::NodePairs links = testing::random_ties(size, random() % 20, random);
  BlockSystem<B> system(size, links);
  for (const double damping : {0.0, 0.3}) {  // the second time in the same memory
    system.forget();
    system.fill(links, random);
    system.damp(damping);
    const auto b = system.right_side(random);
    ASSERT_TRUE(system.factor.factorise()) << seed;
    auto x = b;
    system.factor.solve(x);
    EXPECT_LT(system.distance_from_full_solution(b, x), 1e-9) << B << " " << seed << " " << damping;
    auto twice = b;
    system.factor.solve(twice);
    EXPECT_EQ(twice, x) << "solving does not change the factor";
  }
}

TEST(BlockFactor, SolvesAsTheFullMatrixDoes) {
  for (unsigned seed = 0; seed < 25; ++seed) {
    expect_solved_as_in_full<1>(seed);
    expect_solved_as_in_full<2>(seed);
    expect_solved_as_in_full<3>(seed);
    expect_solved_as_in_full<5>(seed);
  }
}

TEST(BlockFactor, RefusesWhatIsNotPositiveDefinite) {
  const testing::NodePairs link{{0, 1}};
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = HUGE_VAL;
  // Diagonal, off the diagonal, whether x^T A x > 0 for all x.
  const std::vector<std::tuple<double, double, bool>> cases{
      {1.0, 0.5, true},  {1.0, -0.5, true},  {1.0, 1.0, false},      {1.0, 2.0, false},
      {0.0, 0.0, false}, {-1.0, 0.0, false}, {infinite, 0.0, false}, {1.0, nan, false},
      {nan, 0.0, false}, {4.0, 3.9, true},   {4.0, 4.1, false}};
  for (const auto& [diagonal, beside, is_positive] : cases) {
    BlockSystem<1> system(2, link);
    for (const std::size_t v : {0U, 1U}) system.add(v, v, BlockFactor<1>::Block(diagonal));
    system.add(0, 1, BlockFactor<1>::Block(beside));
    EXPECT_EQ(system.factor.factorise(), is_positive) << diagonal << " " << beside;
  }
}

TEST(BlockFactor, RefusesASingularBlock) {
  BlockSystem<2> system(1, {});
  system.add(0, 0, (Eigen::Matrix2d() << 4.0, 2.0, 2.0, 1.0).finished());
  EXPECT_FALSE(system.factor.factorise());
  system.forget();
  system.add(0, 0, (Eigen::Matrix2d() << 4.0, 2.0, 2.0, 1.1).finished());
  EXPECT_TRUE(system.factor.factorise());
}

TEST(BlockFactor, OfNoVariablesIsSolved) {
  BlockSystem<3> system(0, {});
  EXPECT_TRUE(system.factor.factorise());
  std::vector<Eigen::Vector3d> nothing;
  system.factor.solve(nothing);
  EXPECT_TRUE(nothing.empty());
}

}  // namespace
}  // namespace topo::slam

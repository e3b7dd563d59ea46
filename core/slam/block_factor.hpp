// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "core/slam/elimination.hpp"

namespace topo::slam {

/// Cholesky factorisation of a positive definite matrix of B x B blocks, left-looking (Davis 2006, section
/// 4.8). The matrix is written directly into the pattern of the factor and factorised in place. Blocks keep
/// index computations, which dominate a scalar factorisation, out of the inner loops.
template <int B>
class BlockFactor {
 public:
  using Block = Eigen::Matrix<double, B, B>;
  using Vector = Eigen::Matrix<double, B, 1>;

  /// `pattern` must outlive the factor.
  explicit BlockFactor(const Elimination& pattern)
      : pattern_(pattern),
        blocks_(pattern.blocks()),
        where_(pattern.variables()),
        first_(pattern.variables()),
        next_(pattern.variables()),
        cursor_(pattern.variables()),
        scratch_(pattern.variables()) {
    set_zero();
  }

  void set_zero() { std::fill(blocks_.begin(), blocks_.end(), Block::Zero()); }

  /// Adds to the block (row, column) and, by symmetry, to (column, row).
  void add(const Elimination::Place& place, const Block& block) {
    if (place.transposed)
      blocks_[place.index] += block.transpose();
    else
      blocks_[place.index] += block;
  }

  /// Adds f(entry) to each scalar entry of the diagonal.
  template <class F>
  void add_to_diagonal(F&& f) {
    for (std::size_t j = 0; j < pattern_.variables(); ++j) {
      Block& block = blocks_[pattern_.begin(j)];
      for (int i = 0; i < B; ++i) block(i, i) += f(block(i, i));
    }
  }

  /// Factorises in place; false when the matrix is not positive definite to working precision.
  [[nodiscard]] bool factorise() {
    std::fill(first_.begin(), first_.end(), kNone);
    for (std::size_t column = 0; column < pattern_.variables(); ++column) {
      for (std::size_t p = pattern_.begin(column); p < pattern_.begin(column + 1); ++p)
        where_[pattern_.row(p)] = p;
      std::size_t j = first_[column];
      while (j != kNone) {
        const std::size_t after = next_[j];
        subtract(j);
        j = after;
      }
      if (!finish(column)) return false;
    }
    return true;
  }

  /// Solves in place; `x` is in the order of the variables.
  void solve(std::vector<Vector>& x) {
    const std::size_t size = pattern_.variables();
    for (std::size_t i = 0; i < size; ++i) scratch_[pattern_.rank(i)] = x[i];
    for (std::size_t j = 0; j < size; ++j) {
      const std::size_t diagonal = pattern_.begin(j);
      const Vector y = blocks_[diagonal] * scratch_[j];
      scratch_[j] = y;
      for (std::size_t p = diagonal + 1; p < pattern_.begin(j + 1); ++p)
        scratch_[pattern_.row(p)].noalias() -= blocks_[p] * y;
    }
    for (std::size_t j = size; j-- > 0;) {
      const std::size_t diagonal = pattern_.begin(j);
      Vector y = scratch_[j];
      for (std::size_t p = diagonal + 1; p < pattern_.begin(j + 1); ++p)
        y.noalias() -= blocks_[p].transpose() * scratch_[pattern_.row(p)];
      scratch_[j] = blocks_[diagonal].transpose() * y;
    }
    for (std::size_t i = 0; i < size; ++i) x[i] = scratch_[pattern_.rank(i)];
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  /// Subtracts the contribution of the finished column j from the current column, and queues j for its next
  /// row.
  void subtract(std::size_t j) {
    const std::size_t end = pattern_.begin(j + 1), own = cursor_[j];
    Block left = Block::Zero();  // g++ 12 takes Eigen's alias check for a use
    left = blocks_[own].transpose();
    for (std::size_t p = own; p < end; ++p) blocks_[where_[pattern_.row(p)]].noalias() -= blocks_[p] * left;
    queue(j, own + 1, end);
  }

  void queue(std::size_t j, std::size_t block, std::size_t end) {
    cursor_[j] = block;
    if (block == end) return;
    std::size_t& head = first_[pattern_.row(block)];
    next_[j] = head;
    head = j;
  }

  /// Factorises the diagonal block and stores the inverse of its factor there.
  bool finish(std::size_t column) {
    const std::size_t begin = pattern_.begin(column), end = pattern_.begin(column + 1);
    Block inverse;
    if (!inverse_factor(blocks_[begin], inverse)) return false;
    blocks_[begin] = inverse;
    const Block right = inverse.transpose();
    for (std::size_t p = begin + 1; p < end; ++p) blocks_[p] = (blocks_[p] * right).eval();
    queue(column, begin + 1, end);
    return true;
  }

  /// Inverse of the lower Cholesky factor of a small block; reads only the block's lower triangle.
  static bool inverse_factor(const Block& block, Block& inverse) {
    Block l = Block::Zero();
    for (int c = 0; c < B; ++c) {
      for (int r = c; r < B; ++r) {
        double sum = block(r, c);
        for (int k = 0; k < c; ++k) sum -= l(r, k) * l(c, k);
        if (r == c) {
          if (!(sum > 0.0) || !std::isfinite(sum)) return false;
          l(c, c) = std::sqrt(sum);
        } else {
          l(r, c) = sum / l(c, c);
        }
      }
    }
    inverse.setZero();
    for (int c = 0; c < B; ++c) {
      inverse(c, c) = 1.0 / l(c, c);
      for (int r = c + 1; r < B; ++r) {
        double sum = 0.0;
        for (int k = c; k < r; ++k) sum -= l(r, k) * inverse(k, c);
        inverse(r, c) = sum / l(r, r);
      }
    }
    return true;
  }

  const Elimination& pattern_;
  std::vector<Block> blocks_;
  std::vector<std::size_t> where_;   ///< block of each row in the current column
  std::vector<std::size_t> first_;   ///< heads of the lists of columns that contribute to each column
  std::vector<std::size_t> next_;    ///< links of the lists
  std::vector<std::size_t> cursor_;  ///< next block of each finished column
  std::vector<Vector> scratch_;
};

}  // namespace topo::slam

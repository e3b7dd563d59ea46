// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace topo::slam {

/// Symbolic Cholesky factorisation of a symmetric matrix of square blocks: elimination order and pattern of
/// the factor (Davis, Direct Methods for Sparse Linear Systems, 2006, chapter 4). Computed once per graph;
/// the numeric factorisation is repeated by BlockFactor.
class Elimination {
 public:
  /// The two variables of a block off the diagonal.
  using Link = std::pair<std::size_t, std::size_t>;

  /// `links` refer to variables below `variables`, in any order; repetitions are allowed. The elimination
  /// order is approximate minimum degree on the graph of blocks, which is smaller than the scalar matrix by
  /// the block size.
  Elimination(std::size_t variables, std::span<const Link> links);

  /// Where a block is stored in the factor. Only blocks of the lower triangle, after reordering, are stored:
  /// `transposed` is true when the stored block is (column, row) of the requested one.
  struct Place {
    std::size_t index = 0;
    bool transposed = false;
  };
  /// Precondition: row == column, or the two were linked.
  [[nodiscard]] Place place(std::size_t row, std::size_t column) const;

  [[nodiscard]] std::size_t variables() const { return rank_.size(); }
  [[nodiscard]] std::size_t blocks() const { return rows_.size(); }
  /// Position of a variable in the elimination order.
  [[nodiscard]] std::size_t rank(std::size_t variable) const { return rank_[variable]; }
  /// Blocks of column j of the factor: [begin(j), begin(j + 1)), the diagonal first, rows ascending.
  [[nodiscard]] std::size_t begin(std::size_t column) const { return begin_[column]; }
  [[nodiscard]] std::size_t row(std::size_t block) const { return rows_[block]; }

 private:
  void order(std::span<const Link> links);
  void fill(std::span<const Link> links);

  std::vector<std::size_t> rank_;
  std::vector<std::size_t> begin_;
  std::vector<std::size_t> rows_;
};

}  // namespace topo::slam

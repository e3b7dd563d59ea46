// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/elimination.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>

namespace topo::slam {

Elimination::Elimination(std::size_t variables, std::span<const Link> links) : rank_(variables) {
  if (variables > 0) order(links);
  fill(links);
}

void Elimination::order(std::span<const Link> links) {
  const auto size = static_cast<Eigen::Index>(rank_.size());
  std::vector<Eigen::Triplet<float>> entries;
  entries.reserve(links.size() + rank_.size());
  for (Eigen::Index i = 0; i < size; ++i) entries.emplace_back(i, i, 1.0F);
  for (const auto& [a, b] : links)
    entries.emplace_back(static_cast<Eigen::Index>(std::max(a, b)), static_cast<Eigen::Index>(std::min(a, b)),
                         1.0F);
  Eigen::SparseMatrix<float> pattern(size, size);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> eliminated;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Lower>(), eliminated);
  for (Eigen::Index k = 0; k < size; ++k)
    rank_[static_cast<std::size_t>(eliminated.indices()[k])] = static_cast<std::size_t>(k);
}

/// The pattern of column j is the union of the matrix's column and those of its children in the elimination
/// tree (Davis, section 4.1, theorem 4.1 to 4.3).
void Elimination::fill(std::span<const Link> links) {
  const std::size_t size = rank_.size();
  std::vector<std::vector<std::size_t>> below(size);
  for (const auto& [a, b] : links) {
    if (a != b) below[std::min(rank_[a], rank_[b])].push_back(std::max(rank_[a], rank_[b]));
  }
  std::vector<std::size_t> mark(size, size);
  std::vector<std::vector<std::size_t>> children(size);
  begin_.reserve(size + 1);
  for (std::size_t j = 0; j < size; ++j) {
    begin_.push_back(rows_.size());
    mark[j] = j;
    rows_.push_back(j);
    const auto take = [&](std::size_t row) {
      if (mark[row] == j) return;
      mark[row] = j;
      rows_.push_back(row);
    };
    for (const std::size_t row : below[j]) take(row);
    for (const std::size_t child : children[j]) {
      for (std::size_t p = begin_[child] + 1; p < begin_[child + 1]; ++p) take(rows_[p]);
    }
    std::sort(rows_.begin() + static_cast<std::ptrdiff_t>(begin_[j]), rows_.end());
    if (rows_.size() > begin_[j] + 1) children[rows_[begin_[j] + 1]].push_back(j);
  }
  begin_.push_back(rows_.size());
}

Elimination::Place Elimination::place(std::size_t row, std::size_t column) const {
  const std::size_t r = rank_[row], c = rank_[column];
  const std::size_t low = std::min(r, c), high = std::max(r, c);
  const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(begin_[low]);
  const auto last = rows_.begin() + static_cast<std::ptrdiff_t>(begin_[low + 1]);
  return {static_cast<std::size_t>(std::lower_bound(first, last, high) - rows_.begin()), r < c};
}

}  // namespace topo::slam

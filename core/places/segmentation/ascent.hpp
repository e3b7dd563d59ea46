// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/slopes.hpp"

namespace topo::places {

/// Takes the place of a label: no ascent leads to a labelled cell.
inline constexpr std::uint32_t kLost = UINT32_MAX;

/// Gives free cells the label of the first labelled cell on their steepest ascent.
class Ascent {
 public:
  Ascent(const grid::DenseMap& map, const std::vector<Slope>& slopes, std::vector<std::uint32_t>& labels);

  /// Labels a free cell that has no label, and the cells on its ascent. Where clearance rises nowhere, the
  /// ascent continues to a labelled neighbour. Cells whose ascent ends without a label become kLost.
  void climb(std::uint32_t start) {
    if (labels_[start] == 0) climb_up(start);
  }

  /// Cells whose ascent ends without a label.
  [[nodiscard]] const std::vector<std::uint32_t>& lost() const { return lost_; }

 private:
  void climb_up(std::uint32_t start);
  [[nodiscard]] std::uint32_t labelled_beside(std::uint32_t i) const;
  [[nodiscard]] std::uint32_t beside(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k]);
  }

  const Slope* slopes_;
  std::uint32_t* labels_;
  std::array<std::ptrdiff_t, 8> offsets_;
  std::vector<std::uint32_t> way_ = std::vector<std::uint32_t>(64);  ///< grows with the longest ascent
  std::vector<std::uint32_t> lost_;
};

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types/se2.hpp"

namespace topo::slam {

/// A path in stretches of 2.5 m, and for each the others that belong to another visit: the way between the
/// two is at least 15 m and at least twice as long as they are apart. So a straight corridor seen from both
/// ends in passing is one visit, coming back is another.
class Visits {
 public:
  explicit Visits(std::span<const types::Se2> poses);

  [[nodiscard]] std::size_t words() const { return words_; }  ///< of a set of stretches
  [[nodiscard]] std::size_t stretch_of(std::size_t keyframe) const { return stretch_of_[keyframe]; }
  /// The set of stretches of other visits, a bit each.
  [[nodiscard]] const std::uint64_t* others(std::size_t stretch) const { return &others_[stretch * words_]; }
  [[nodiscard]] bool are_apart(std::size_t a, std::size_t b) const {
    return (others(a)[b / 64] >> (b % 64) & 1U) != 0;
  }

 private:
  std::size_t words_ = 0;
  std::vector<std::size_t> stretch_of_;
  std::vector<std::uint64_t> others_;
};

}  // namespace topo::slam

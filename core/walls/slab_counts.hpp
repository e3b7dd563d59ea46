// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "core/walls/height_column.hpp"

namespace topo::walls {

/// How often each slab of a cell was seen, up to 65535 times. The counters are bit-sliced: word k holds bit k
/// of all of them, so that one addition with carries of whole words counts a column (Knuth, TAOCP 4A, 7.1.3:
/// sideways addition): two steps on average for all heights together.
class SlabCounts {
 public:
  void add(Slabs slabs) {
    for (std::size_t bit = 0; slabs != 0 && bit < bits_.size(); ++bit) {
      const Slabs carry = bits_[bit] & slabs;
      bits_[bit] ^= slabs;
      slabs = carry;
    }
  }
  /// Precondition: the slabs were added before.
  void remove(Slabs slabs) {
    for (std::size_t bit = 0; slabs != 0 && bit < bits_.size(); ++bit) {
      const Slabs borrow = ~bits_[bit] & slabs;
      bits_[bit] ^= slabs;
      slabs = borrow;
    }
  }
  /// Slabs with a count above 0.
  [[nodiscard]] Slabs seen() const {
    Slabs any = 0;
    for (const Slabs word : bits_) any |= word;
    return any;
  }

 private:
  std::array<Slabs, 16> bits_{};
};

}  // namespace topo::walls

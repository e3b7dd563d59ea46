// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "core/walls/height_column.hpp"

namespace topo::walls {

/// How often each slab of a cell was seen, up to 65535 times. The counters stand upright beside each other,
/// word k holding bit k of all of them, so that a column is counted as one number is, with carries that are
/// words (Knuth, TAOCP 4A, 7.1.3: sideways addition): two steps on the average for all heights together.
class SlabCounts {
 public:
  void add(Slabs slabs) {
    for (std::size_t bit = 0; slabs != 0 && bit < bits_.size(); ++bit) {
      const Slabs carry = bits_[bit] & slabs;
      bits_[bit] ^= slabs;
      slabs = carry;
    }
  }
  /// Slabs that were added before.
  void remove(Slabs slabs) {
    for (std::size_t bit = 0; slabs != 0 && bit < bits_.size(); ++bit) {
      const Slabs borrow = ~bits_[bit] & slabs;
      bits_[bit] ^= slabs;
      slabs = borrow;
    }
  }
  /// Those that were seen at all.
  [[nodiscard]] Slabs seen() const {
    Slabs any = 0;
    for (const Slabs word : bits_) any |= word;
    return any;
  }

 private:
  std::array<Slabs, 16> bits_{};
};

}  // namespace topo::walls

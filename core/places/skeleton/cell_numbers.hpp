// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace topo::places {

/// Numbers for a few of a map's many cells, 0 for the others. Only blocks with a number use memory.
class CellNumbers {
 public:
  explicit CellNumbers(std::size_t cells) : blocks_(cells / kBlock + 1, 0), numbers_(kBlock, 0) {}

  [[nodiscard]] std::uint32_t at(std::uint32_t cell) const {
    return numbers_[blocks_[cell / kBlock] + cell % kBlock];
  }
  void set(std::uint32_t cell, std::uint32_t number) {
    std::uint32_t& block = blocks_[cell / kBlock];
    if (block == 0) {
      block = static_cast<std::uint32_t>(numbers_.size());
      numbers_.resize(numbers_.size() + kBlock, 0);
    }
    numbers_[block + cell % kBlock] = number;
  }

 private:
  static constexpr std::uint32_t kBlock = 32;
  std::vector<std::uint32_t> blocks_;   ///< start of each block's numbers; 0: the shared empty block
  std::vector<std::uint32_t> numbers_;  ///< the first block is that of all blocks without a number
};

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/skeleton/thinning_state.hpp"
#include "core/places/skeleton/turn_queues.hpp"

namespace topo::places {

/// Finds the consistent states of all free cells.
///
/// The outcome of a cell depends only on the outcomes of its neighbours when its turn comes. Turns are
/// ordered by bucket of clearance; within a bucket, cells beside one that had to stay come last (so that the
/// connection runs straight up the slope, and not askew in the order of the cells' numbers), the others by
/// number. Most states are therefore known in advance: a cell on a slope whose earlier neighbours are all
/// removed is simple, and is removed. Only the other cells are examined one by one. When the outcome of a
/// cell differs from the assumed one, its later neighbours are examined again. Because a state depends on
/// earlier turns only, exactly one set of states is consistent, whatever the order of the search. Strips of
/// rows, each small enough for the cache, are therefore settled one after the other until no cell is in
/// doubt.
class Settling {
 public:
  /// `states` of the map's cells, settled except for the cells passed to doubt().
  Settling(const grid::DenseMap& map, std::vector<ThinningState>& states);

  /// Marks a free cell whose state may be inconsistent with those of its neighbours.
  void doubt(std::uint32_t i) {
    if (is_in_doubt(i)) return;
    fates_[i] |= kQueued;
    doubtful_[i / strip_cells_].push_back(i);
  }
  [[nodiscard]] bool is_in_doubt(std::uint32_t i) const { return (fates_[i] & kQueued) != 0; }
  void settle_all();

 private:
  /// The neighbours of a cell at a turn: bit k of each for neighbour k.
  struct Around {
    unsigned kept = 0;
    unsigned later = 0;  ///< neighbours with a later turn, or with the same one and a greater number
    unsigned queued = 0;
  };

  [[nodiscard]] std::uint32_t neighbour(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k]);
  }
  [[nodiscard]] Around around(std::uint32_t i, unsigned turn) const;
  [[nodiscard]] bool stays(std::uint32_t i, const Around& around) const;

  /// Settles one strip against the present states of the others, which may become doubtful. True when a cell
  /// was in doubt.
  bool settle_strip(std::size_t strip);
  void decide(std::uint32_t i);
  void decide_last(std::uint32_t i);
  void queue(std::uint32_t i, Rising& cells);
  void settle(std::uint32_t i, const Around& around, ThinningState outcome, bool last);

  ThinningState* fates_;
  std::array<std::ptrdiff_t, 8> offsets_;
  std::size_t strip_cells_;
  std::vector<std::vector<std::uint32_t>> doubtful_;  ///< of each strip
  // Of the current strip.
  std::uint32_t first_cell_ = 0;
  std::size_t bucket_ = 0;
  Buckets buckets_;
  Rising first_, last_;
};

}  // namespace topo::places

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

/// Finds the states of free cells that fit together.
///
/// What becomes of a cell depends on what has become of its neighbours when its turn comes, and on nothing
/// else. Turns are by bucket of clearance; within a bucket those beside a cell that had to stay come last (so
/// the connection goes straight up the slope, and not askew in the order of the cells' numbers), otherwise by
/// number. So most states are known beforehand: a cell on a slope, all of whose earlier neighbours are gone,
/// is simple and goes. Only the others are looked at one after the other, and whoever turns out other than
/// was assumed has its later neighbours looked at again. What was assumed may also be the states on an
/// earlier map. Because a state depends on earlier turns only, there is one set of states that fits together,
/// in whatever order it is found: so strips of rows are settled one after the other, each small enough for
/// the cache, until nothing is in doubt.
class Settling {
 public:
  /// `states` of the map's cells, settled but for those that doubt() is told.
  Settling(const grid::DenseMap& map, std::vector<ThinningState>& states);

  /// A free cell whose state may not be what its neighbours' say.
  void doubt(std::uint32_t i) {
    if (is_in_doubt(i)) return;
    fates_[i] |= kQueued;
    doubtful_[i / strip_cells_].push_back(i);
  }
  [[nodiscard]] bool is_in_doubt(std::uint32_t i) const { return (fates_[i] & kQueued) != 0; }
  /// A free cell that may be in another bucket, or on the ridge where it was not; in doubt from now on.
  void renew(std::uint32_t i, ThinningState state) {
    if (fates_[i] >> kTurnShift != state >> kTurnShift) others_.push_back(i);
    fates_[i] = state;
    doubt(i);
  }

  void settle_all();

  /// Cells that have been renewed or settled with another turn or outcome, some of them repeatedly.
  [[nodiscard]] const std::vector<std::uint32_t>& others() const { return others_; }

 private:
  /// A cell's neighbours as they are at a turn: bit k of each for neighbour k.
  struct Around {
    unsigned kept = 0;
    unsigned later = 0;  ///< its turn comes after that one, or is the same and its number is greater
    unsigned queued = 0;
  };

  [[nodiscard]] std::uint32_t neighbour(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k]);
  }
  [[nodiscard]] Around around(std::uint32_t i, unsigned turn) const;
  [[nodiscard]] bool stays(std::uint32_t i, const Around& around) const;

  /// Settles one strip as the others are, which may come to be in doubt. True when there was something to do.
  bool settle_strip(std::size_t strip);
  void decide(std::uint32_t i);
  void decide_last(std::uint32_t i);
  void queue(std::uint32_t i, Rising& cells);
  void settle(std::uint32_t i, const Around& around, ThinningState outcome, bool last);

  ThinningState* fates_;
  std::array<std::ptrdiff_t, 8> offsets_;
  std::size_t strip_cells_;
  std::vector<std::vector<std::uint32_t>> doubtful_;  ///< of each strip
  std::vector<std::uint32_t> others_;
  // Of the strip at hand.
  std::uint32_t first_cell_ = 0;
  std::size_t bucket_ = 0;
  Buckets buckets_;
  Rising first_, last_;
};

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/compass/projection.hpp"
#include "core/types/geometry.hpp"

namespace topo::compass {

/// Parameters of the conversion of points to a cloud.
struct Placing {
  types::Vector2 middle{0.0, 0.0};  ///< centre of the points
  double half_bin_m = 0.0;
  double cell_m = 0.0;
};

/// A point with its hash, which decides whether the point is left out and where in its cell it is placed:
/// rows of cell centres would have a direction of their own, that of the raster. Neither depends on other
/// points.
struct Sample {
  explicit Sample(const types::Vector2& p);
  void append_to(Cloud& cloud, const Placing& placing) const;

  types::Vector2 p;
  std::uint64_t hash;
};

/// About `size` of `points` points have a hash of no more than this.
std::uint64_t hash_limit(std::size_t points, std::size_t size);

/// Points in the order of their hashes, roughly: the points up to a limit are found without a search of the
/// others. Value type.
class Samples {
 public:
  explicit Samples(std::span<const types::Vector2> points);

  /// Points with a hash up to a limit. The order of hashes separates neighbours: consecutive points rarely
  /// fall into one bin, and no count waits for the one before it.
  [[nodiscard]] Cloud up_to(std::uint64_t limit, const Placing& placing) const;

 private:
  [[nodiscard]] std::size_t bucket_of(std::uint64_t hash) const {
    return static_cast<std::size_t>(hash >> 32U) >> shift_;
  }

  unsigned shift_;
  std::vector<std::vector<Sample>> buckets_;  ///< in the order of hashes
};

}  // namespace topo::compass

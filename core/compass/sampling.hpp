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
  friend bool operator==(const Placing&, const Placing&) = default;
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

/// Points by hash: the points up to a limit, or between two limits, are found without a search of the others.
/// Value type.
class Samples {
 public:
  Samples() = default;
  explicit Samples(std::span<const types::Vector2> points);

  void add(const types::Vector2& p);
  /// Precondition: the point is present.
  void remove(const types::Vector2& p);

  /// Calls f(sample) for the samples with a hash in [least, most].
  template <class F>
  void for_each_within(std::uint64_t least, std::uint64_t most, F&& f) const {
    for (std::size_t b = bucket_of(least); b <= bucket_of(most); ++b)
      for (const Sample& sample : buckets_[b])
        if (sample.hash >= least && sample.hash <= most) f(sample);
  }
  /// Points with a hash up to a limit. The order of hashes separates neighbours: consecutive points rarely
  /// fall into one bin, and no count waits for the one before it.
  [[nodiscard]] Cloud up_to(std::uint64_t limit, const Placing& placing) const;

 private:
  [[nodiscard]] std::size_t bucket_of(std::uint64_t hash) const {
    return static_cast<std::size_t>(hash >> 32U) >> shift_;
  }

  unsigned shift_ = 32;
  std::vector<std::vector<Sample>> buckets_ =
      std::vector<std::vector<Sample>>(1);  ///< in the order of hashes
};

}  // namespace topo::compass

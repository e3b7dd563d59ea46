// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "core/types/geometry.hpp"
#include "core/walls/projection.hpp"

namespace topo::walls {

/// How points become a cloud.
struct Placing {
  types::Vector2 middle{0.0, 0.0};  ///< of the points
  double half_bin_m = 0.0;
  double cell_m = 0.0;
  friend bool operator==(const Placing&, const Placing&) = default;
};

/// A point with what decides whether it is left out and where in its cell it is put: rows of cell centres
/// would be a direction of their own, that of the raster. Neither depends on other points.
struct Sample {
  explicit Sample(const types::Vector2& p);
  [[nodiscard]] float x(const Placing& placing) const;
  [[nodiscard]] float y(const Placing& placing) const;

  types::Vector2 p;
  std::uint64_t hash;
};

/// About `size` of so many points have a hash of no more than this.
std::uint64_t hash_limit(std::size_t points, std::size_t size);

/// Those up to a limit, neighbours far from each other: what falls into one bin is then not counted one
/// after the other, and no count waits for the one before it.
Cloud sampled(std::span<const Sample> samples, std::uint64_t limit, const Placing& placing);

}  // namespace topo::walls

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/grid/occupancy_grid.hpp"
#include "core/places/skeleton/erosion.hpp"

namespace topo::places {

/// A cell's bucket, an eighth of a cell of clearance wide, above its flags. Only cells that are not free have
/// bucket 0; clearances from 512 cells on share one bucket.
using ThinningState = std::uint16_t;
inline constexpr int kBucketShift = 4;
inline constexpr std::size_t kBuckets = 4096;
inline constexpr ThinningState kFlags = (1U << kBucketShift) - 1;

/// In doubt, and waiting for its turn.
inline constexpr ThinningState kQueued = 1;
inline constexpr ThinningState kOutcome = Erosion::kKept | Erosion::kDelayed;

/// Shift that leaves a cell's turn: its bucket, with the delayed flag below, so that delayed cells come last.
inline constexpr int kTurnShift = 3;
static_assert(Erosion::kDelayed == 1U << kTurnShift);

/// A state that holds only its bucket.
inline ThinningState state_of(float clearance_m, float buckets_per_m) {
  const float bucket = std::min(clearance_m * buckets_per_m, static_cast<float>(kBuckets - 1));
  return static_cast<ThinningState>(static_cast<std::int32_t>(bucket) << kBucketShift);
}

inline std::size_t bucket_of(ThinningState state) { return static_cast<std::size_t>(state >> kBucketShift); }

/// Factor for state_of: buckets are an eighth of a cell wide.
inline float buckets_per_m(const grid::DenseMap& map) { return static_cast<float>(8.0 / map.resolution_m); }

/// Unlike std::max without references, which prevent vectorisation.
inline float larger(float a, float b) { return a < b ? b : a; }

/// On the ridge no neighbour has much more clearance. Beside a single wall, clearance rises by nearly a cell
/// per cell in some direction (at least 0.92, because neighbours lie in eight directions), on the axis of a
/// right-angled corner by 0.71, in a corridor not at all. Near the boundary, where distances jump, only cells
/// as flat as in a corridor count.
inline bool is_ridge(float here_m, float side_m, float corner_m, float cell_m) {
  const float rise_m = larger(side_m - here_m, (corner_m - here_m) * 0.70711F);
  const float flat_m = here_m < 3.0F * cell_m ? 0.3F * cell_m : 0.8F * cell_m;
  return rise_m < flat_m;
}

}  // namespace topo::places

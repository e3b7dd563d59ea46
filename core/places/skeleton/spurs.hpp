// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/skeleton/cell_numbers.hpp"
#include "core/places/skeleton/skeleton.hpp"
#include "core/places/skeleton/thinning.hpp"

namespace topo::places {

/// Drops spurs: uneven walls cause short side branches, which have no meaning for the structure of free
/// space. The search begins at their ends: most of the axis lies between junctions, and is not examined.
class Spurs {
 public:
  Spurs(const grid::DenseMap& map, std::span<const float> clearance_m, const SkeletonParams& params)
      : map_(map),
        clearance_m_(clearance_m),
        params_(params),
        offsets_(neighbour_offsets(map)),
        junction_of_(map.cells.size()) {}

  /// Removes all spurs from an axis thinned to lines. True when there was one.
  bool drop(Thinning& thinning);

 private:
  /// Adjacent cells with more than two neighbours each.
  struct Junction {
    std::uint32_t clearest = 0;  ///< of its cells
    std::size_t exits = 0;       ///< neighbours that lead out of the junction
  };
  /// The axis from an end to the next junction.
  struct Branch {
    std::uint32_t junction = 0;  ///< one of its cells
    float length_m = 0.0F;
  };

  std::optional<Branch> follow(std::uint32_t end, const Thinning& thinning);
  const Junction& junction_at(std::uint32_t cell, Thinning& thinning);
  [[nodiscard]] double protrusion_m(std::uint32_t end, const Junction& junction, float length_m) const;
  [[nodiscard]] std::uint32_t neighbour(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k]);
  }

  const grid::DenseMap& map_;
  std::span<const float> clearance_m_;
  SkeletonParams params_;
  std::array<std::ptrdiff_t, 8> offsets_;
  CellNumbers junction_of_;  ///< number of the junction, for cells marked as nodes
  std::vector<Junction> junctions_;
  std::vector<std::uint32_t> at_junctions_;  ///< cells of the junctions
  std::vector<std::uint32_t> way_;           ///< the branch followed last, without its junction
};

}  // namespace topo::places

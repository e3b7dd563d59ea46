// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/grid/wavefront.hpp"

namespace topo::exploration {

/// What the ways between goals cost. Most goals are the same from one decision to the next, and so are most
/// ways: only those of new goals are searched, and in turn one of the old, since doors open and close. When a
/// map is corrected all are new at once; then a few are searched every time, and the rest is estimated by
/// what was known beside them and by ways over those that were searched.
class GoalWays {
 public:
  /// Costs among `cells` on this map from now on; travel_field has the other arguments. Costs at most three
  /// searches of the map, as far as the other cells.
  void update(const grid::DenseMap& map, std::span<const float> clearance_m, const grid::TravelRules& rules,
              std::span<const grid::CellIndex> cells);

  /// The map was corrected, or time has passed: all are searched again, in their turns.
  void doubt() { is_searched_.assign(is_searched_.size(), false); }

  /// Metres of open travel between two of the cells, the same both ways; HUGE_VAL where no way was found.
  /// That of the search once each had its turn: after as many updates with these cells as they are, at the
  /// latest.
  [[nodiscard]] double between_m(std::size_t a, std::size_t b) const {
    return cost_m_[a * cells_.size() + b];
  }

 private:
  void take_over(std::span<const grid::CellIndex> cells, double cell_m);
  [[nodiscard]] std::vector<std::size_t> to_search();
  void bridge(std::span<const std::size_t> searched);
  void search_from(std::size_t from, std::span<const std::size_t> to, const grid::DenseMap& map,
                   std::span<const float> clearance_m, const grid::TravelRules& rules);

  std::vector<grid::CellIndex> cells_;
  std::vector<double> cost_m_;     ///< cells times cells, symmetric
  std::vector<bool> is_searched_;  ///< its ways were searched for, and need not be estimated
  std::size_t turn_ = 0;           ///< counts updates: whose turn it is
  grid::TravelSearch search_;
  grid::TravelField field_;
};

}  // namespace topo::exploration

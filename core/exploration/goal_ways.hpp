// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/exploration/params.hpp"
#include "core/grid/wavefront.hpp"

namespace topo::exploration {

/// Costs of routes between goals. Most goals, and so most routes, are the same from one decision to the next:
/// only the routes of new goals are searched and, in turn, one of the old, since doors open and close. When a
/// correction of the map changes all goals at once, a few are searched at each update. The others are
/// estimated from earlier costs beside them and from routes through searched goals.
class GoalWays {
 public:
  explicit GoalWays(const GoalWaysParams& params = {}) : params_(params) {}

  /// Updates the costs to `cells` on this map; the other arguments are those of travel_field. Costs at most
  /// GoalWaysParams::searches of the map, each as far as the other cells.
  void update(const grid::DenseMap& map, std::span<const float> clearance_m, const grid::TravelRules& rules,
              std::span<const grid::CellIndex> cells);

  /// The map was corrected, or time has passed: all are searched again in turn.
  void doubt() { is_searched_.assign(is_searched_.size(), false); }

  /// Metres of open travel between two of the cells, equal in both directions; HUGE_VAL where no route was
  /// found. Exact once each cell had its turn: at the latest after as many updates with these cells as there
  /// are cells.
  [[nodiscard]] double between_m(std::size_t a, std::size_t b) const {
    return cost_m_[a * cells_.size() + b];
  }

 private:
  void take_over(std::span<const grid::CellIndex> cells, double cell_m);
  [[nodiscard]] std::vector<std::size_t> to_search();
  void bridge(std::span<const std::size_t> searched);
  void search_from(std::size_t from, std::span<const std::size_t> to, const grid::DenseMap& map,
                   std::span<const float> clearance_m, const grid::TravelRules& rules);

  GoalWaysParams params_;
  std::vector<grid::CellIndex> cells_;
  std::vector<double> cost_m_;     ///< cells times cells, symmetric
  std::vector<bool> is_searched_;  ///< its routes were searched and are not estimates
  std::size_t turn_ = 0;           ///< number of updates, which defines the turn
  grid::TravelSearch search_;
  grid::TravelField field_;
};

}  // namespace topo::exploration

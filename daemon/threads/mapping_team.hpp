// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/pipeline/mapping_step.hpp"
#include "core/types/scan.hpp"
#include "daemon/threads/team_hand_over.hpp"

namespace topo::daemon {

/// The mapping thread's side of the team: what mates know enters the map, what is new here leaves it, and the
/// mates' bodies are cut out of the scans, because they would stay in the map as walls.
class MappingTeam {
 public:
  MappingTeam(TeamHandOver& team, const slam::MapperParams& params);

  /// Joins what has come, and answers the team's thread. `map`: the number of the present map.
  void serve(pipeline::MappingState& state, std::uint64_t map);

  /// The scan without the beams that end on a mate near its last known place; the scan itself when there is
  /// none near. Valid until the next call.
  const types::Scan* without_mates_front(const types::Scan* scan, const types::Se2& T_map_base);
  const types::Scan* without_mates_coronal(const types::Scan* scan, const types::Se2& T_map_base);

 private:
  [[nodiscard]] std::vector<types::Vector2> mates_near(const types::Se2& T_map_base, types::Stamp now);

  TeamHandOver& team_;
  types::Se2 T_base_front_, T_base_coronal_;
  types::Scan front_, coronal_;  ///< masked copies
};

}  // namespace topo::daemon

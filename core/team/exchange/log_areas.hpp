// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <vector>

#include "core/team/exchange/log_entry.hpp"

namespace topo::team {

/// An area of the log that nobody has withdrawn; corners in the map frame of id.origin(), metres.
struct TeamArea {
  EntryId id;
  types::Polygon corners_map;
  types::AreaKind kind = types::AreaKind::kKeepOut;
};

/// What a log says of areas, in whatever order its entries came. A withdrawal by the area's own robot counts
/// once all is there that this robot said before: an area that moved, or that a restarted robot has said
/// anew, is never missing in between.
struct LogAreas {
  std::vector<TeamArea> areas;  ///< in the order of their keys
  std::set<EntryId> withdrawn;  ///< also before a mate's withdrawn area itself is here
};
[[nodiscard]] LogAreas areas_of(const std::vector<LogEntry>& log);

}  // namespace topo::team

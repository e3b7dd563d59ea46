// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <vector>

#include "core/team/exchange/log_entry.hpp"

namespace topo::team {

/// An area of the log that nobody has withdrawn; corners in the map frame of id.origin(), metres.
struct TeamArea {
  EntryId id;
  types::Polygon corners_map;  ///< where its robot said last
  types::AreaKind kind = types::AreaKind::kKeepOut;
};

/// What a log says of areas, in whatever order its entries came.
struct LogAreas {
  std::vector<TeamArea> areas;  ///< in the order of their keys
  std::set<EntryId> withdrawn;  ///< also before the area itself is here
  /// Areas of a run that other runs of the same robot withdrew, and which: these say them anew, in maps that
  /// need not have a place here yet. They are among `areas` too.
  std::map<EntryId, std::set<slam::Origin>> said_anew;
};
[[nodiscard]] LogAreas areas_of(const std::vector<LogEntry>& log);

}  // namespace topo::team

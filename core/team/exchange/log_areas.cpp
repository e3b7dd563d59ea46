// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/log_areas.hpp"

#include <algorithm>

namespace topo::team {

LogAreas areas_of(const std::vector<LogEntry>& log) {
  LogAreas found;
  for (const LogEntry& entry : log)
    if (const auto* withdrawn = std::get_if<Withdrawn>(&entry.body)) found.withdrawn.insert(withdrawn->area);
  for (const LogEntry& entry : log) {
    if (found.withdrawn.contains(entry.id)) continue;
    if (const auto* area = std::get_if<KeepOut>(&entry.body))
      found.areas.push_back({entry.id, area->corners_map, types::AreaKind::kKeepOut});
    if (const auto* area = std::get_if<HereFirst>(&entry.body))
      found.areas.push_back({entry.id, area->corners_map, types::AreaKind::kHereFirst});
  }
  std::ranges::sort(found.areas, {}, &TeamArea::id);
  return found;
}

}  // namespace topo::team

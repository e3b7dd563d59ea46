// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/log_areas.hpp"

#include <algorithm>

namespace topo::team {
namespace {

/// Is all there that the area's robot said before it withdrew it: from the area on, or of a later run all?
bool has_all_before(const std::set<EntryId>& log, const EntryId& withdrawal, const EntryId& area) {
  EntryId before = withdrawal;
  before.sequence = area.origin() == withdrawal.origin() ? area.sequence : 0;
  for (; before.sequence < withdrawal.sequence; ++before.sequence)
    if (before != area && !log.contains(before)) return false;
  return true;
}

}  // namespace

LogAreas areas_of(const std::vector<LogEntry>& log) {
  LogAreas found;
  std::set<EntryId> ids;
  for (const LogEntry& entry : log) ids.insert(entry.id);
  for (const LogEntry& entry : log) {
    const auto* withdrawn = std::get_if<Withdrawn>(&entry.body);
    if (withdrawn == nullptr) continue;
    if (withdrawn->area.robot != entry.id.robot || has_all_before(ids, entry.id, withdrawn->area))
      found.withdrawn.insert(withdrawn->area);
  }
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

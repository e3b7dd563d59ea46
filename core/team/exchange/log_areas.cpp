// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/log_areas.hpp"

#include <algorithm>

namespace topo::team {
namespace {

/// Where an area is, and the number of the entry that says so.
struct Place {
  std::uint32_t number = 0;
  const types::Polygon* corners_map = nullptr;
};

/// The last place of each area that its robot has moved.
std::map<EntryId, Place> moved_places(const std::vector<LogEntry>& log) {
  std::map<EntryId, Place> places;
  for (const LogEntry& entry : log) {
    const auto* moved = std::get_if<AreaMoved>(&entry.body);
    if (moved == nullptr || moved->area.origin() != entry.id.origin()) continue;
    Place& place = places[moved->area];
    if (place.corners_map == nullptr || place.number < entry.id.sequence)
      place = {entry.id.sequence, &moved->corners_map};
  }
  return places;
}

}  // namespace

LogAreas areas_of(const std::vector<LogEntry>& log) {
  LogAreas found;
  for (const LogEntry& entry : log) {
    const auto* withdrawn = std::get_if<Withdrawn>(&entry.body);
    if (withdrawn == nullptr) continue;
    const EntryId& area = withdrawn->area;
    if (area.robot == entry.id.robot && area.run != entry.id.run)
      found.said_anew[area].insert(entry.id.origin());
    else
      found.withdrawn.insert(area);
  }
  const std::map<EntryId, Place> places = moved_places(log);
  const auto add = [&](const EntryId& id, const types::Polygon& drawn, types::AreaKind kind) {
    const auto place = places.find(id);
    const bool is_moved = place != places.end() && place->second.corners_map->size() == drawn.size();
    found.areas.push_back({id, is_moved ? *place->second.corners_map : drawn, kind});
  };
  for (const LogEntry& entry : log) {
    if (found.withdrawn.contains(entry.id)) continue;
    if (const auto* area = std::get_if<KeepOut>(&entry.body))
      add(entry.id, area->corners_map, types::AreaKind::kKeepOut);
    if (const auto* area = std::get_if<HereFirst>(&entry.body))
      add(entry.id, area->corners_map, types::AreaKind::kHereFirst);
  }
  std::ranges::sort(found.areas, {}, &TeamArea::id);
  return found;
}

}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/team/exchange/codecs.hpp"
#include "core/team/exchange/exchange_state.hpp"

namespace topo::team {
namespace {

using types::Vector2;
using Places = std::vector<Vector2>;

void apply(Places& places, const Vector2& p_map, bool again) {
  const auto at = std::find(places.begin(), places.end(), p_map);
  if (again && at != places.end()) places.erase(at);
  if (!again && at == places.end()) places.push_back(p_map);
}

template <class Entry>
void find_changes(const Places& before, const Places& now, std::vector<LogBody>& changes) {
  const auto has = [](const Places& places, const Vector2& p) {
    return std::find(places.begin(), places.end(), p) != places.end();
  };
  for (const Vector2& p : before) {
    if (!has(now, p)) changes.emplace_back(Entry{p, true});
  }
  Places noted = before;
  for (const Vector2& p : now) {
    if (has(noted, p) || !p.allFinite()) continue;
    changes.emplace_back(Entry{p, false});
    noted.push_back(p);
  }
}

}  // namespace

LogPlaces places_of(const ItemStore& store, const slam::Origin& origin) {
  LogPlaces places;
  const ItemStream* log = store.stream({ItemKind::kLog, origin});
  if (log == nullptr) return places;
  for (const auto& [number, bytes] : log->items()) {
    const auto body = decode_log(*bytes);
    if (!body) continue;
    if (const auto* visited = std::get_if<Visited>(&*body))
      apply(places.visited, visited->p_map, visited->again);
    if (const auto* looked = std::get_if<LookedInto>(&*body))
      apply(places.looked, looked->p_map, looked->again);
  }
  return places;
}

std::vector<LogBody> changes(const LogPlaces& before, const StatusMessage& status) {
  std::vector<LogBody> found;
  find_changes<Visited>(before.visited, status.visited, found);
  find_changes<LookedInto>(before.looked, status.looked, found);
  return found;
}

}  // namespace topo::team

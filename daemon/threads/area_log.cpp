// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/area_log.hpp"

#include <algorithm>
#include <utility>

namespace topo::daemon {
namespace {

bool is_of_areas(const team::LogEntry& entry) {
  return std::holds_alternative<team::KeepOut>(entry.body) ||
         std::holds_alternative<team::HereFirst>(entry.body) ||
         std::holds_alternative<team::AreaMoved>(entry.body) ||
         std::holds_alternative<team::Withdrawn>(entry.body);
}

team::LogBody entry_for(const AreaWishes::Own& area) {
  if (area.kind == types::AreaKind::kHereFirst) return team::HereFirst{area.corners_map};
  return team::KeepOut{area.corners_map};
}

bool are_near(const types::Polygon& a, const types::Polygon& b, double within_m) {
  return std::ranges::equal(
      a, b, [&](const types::Vector2& p, const types::Vector2& q) { return (p - q).norm() <= within_m; });
}

types::Polygon in_frame(const types::Se2& T_map_mates, types::Polygon corners) {
  for (types::Vector2& corner : corners) corner = T_map_mates * corner;
  return corners;
}

}  // namespace

void AreaLog::begin_map() {
  own_.clear();
  frames_.clear();
  changed_ = true;
}

void AreaLog::want(const AreaWishes& wishes) {
  wishes_ = wishes;
  changed_ = true;
}

void AreaLog::note(const std::vector<team::LogEntry>& entries) {
  changed_ = changed_ || std::ranges::any_of(entries, &is_of_areas);
}

void AreaLog::place(const slam::Origin& origin, const types::Se2& T_map_mates) {
  const auto [at, is_new] = frames_.try_emplace(origin, T_map_mates);
  if (!is_new && !types::is_apart(at->second, T_map_mates, params_.moved_m, params_.moved_rad)) return;
  at->second = T_map_mates;
  changed_ = true;
}

bool AreaLog::settle(team::Exchange& exchange) {
  if (!std::exchange(changed_, false)) return false;
  self_ = {exchange.identity().robot, exchange.identity().run};
  log_ = team::areas_of(team::log_of(exchange.items()));
  for (const AreaWishes::Own& area : wishes_.own) say(exchange, area);
  std::erase_if(own_, [&](const auto& own) {
    if (std::ranges::count(wishes_.own, own.first, &AreaWishes::Own::number) > 0) return false;
    withdraw(exchange, own.second.id);
    return true;
  });
  for (const team::EntryId& id : wishes_.withdrawn) withdraw(exchange, id);
  for (const team::TeamArea& area : log_.areas)
    if (is_said_again(area)) withdraw(exchange, area.id);
  log_ = team::areas_of(team::log_of(exchange.items()));
  return true;
}

void AreaLog::say(team::Exchange& exchange, const AreaWishes::Own& area) {
  const auto at = own_.find(area.number);
  if (at == own_.end()) {
    if (const auto id = exchange.add_entry(entry_for(area)))
      own_[area.number] = {*id, area.corners_map, area.corners_map};
  } else if (!are_near(at->second.corners_map, area.corners_map, params_.moved_m)) {
    if (exchange.add_entry(team::AreaMoved{at->second.id, area.corners_map}))
      at->second.corners_map = area.corners_map;
  }
}

bool AreaLog::is_said_again(const team::TeamArea& area) const {
  if (area.id.robot != self_.robot || area.id.run == self_.run) return false;
  return std::ranges::any_of(wishes_.own, [&](const AreaWishes::Own& own) {
    const auto at = own_.find(own.number);
    return own.kind == area.kind && at != own_.end() &&
           are_near(at->second.drawn_map, area.corners_map, params_.moved_m);
  });
}

void AreaLog::withdraw(team::Exchange& exchange, const team::EntryId& id) {
  // Of another run of this robot the log has it as said anew.
  const auto anew = log_.said_anew.find(id);
  if (anew != log_.said_anew.end() && anew->second.contains(self_)) return;
  if (!log_.withdrawn.insert(id).second) return;
  (void)exchange.add_entry(team::Withdrawn{id});  // a key has nothing that could be refused
}

TeamAreas AreaLog::report() const {
  TeamAreas areas;
  areas.withdrawn.assign(log_.withdrawn.begin(), log_.withdrawn.end());
  for (const auto& [number, logged] : own_)
    if (log_.withdrawn.contains(logged.id)) areas.own_withdrawn.push_back(number);
  for (const team::TeamArea& area : log_.areas) {
    if (std::ranges::any_of(own_, [&](const auto& own) { return own.second.id == area.id; })) continue;
    const auto frame = frames_.find(area.id.origin());
    if (const auto anew = log_.said_anew.find(area.id); anew != log_.said_anew.end()) {
      // In force where it was until a map that has it anew has a place here.
      const bool is_replaced = std::ranges::any_of(
          anew->second, [&](const slam::Origin& run) { return run == self_ || frames_.contains(run); });
      if (is_replaced) areas.withdrawn.push_back(area.id);
      if (is_replaced || frame == frames_.end()) continue;
    }
    areas.of_mates.push_back(
        {area.id,
         frame == frames_.end() ? std::nullopt : std::optional(in_frame(frame->second, area.corners_map)),
         area.kind});
  }
  return areas;
}

}  // namespace topo::daemon

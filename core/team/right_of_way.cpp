// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/right_of_way.hpp"

#include <algorithm>
#include <cmath>

namespace topo::team {
namespace {

using types::Vector2;

bool leads_through(std::span<const Vector2> way, const Vector2& p, double room_m) {
  return std::any_of(way.begin(), way.end(),
                     [&](const Vector2& w) { return (w - p).squaredNorm() < room_m * room_m; });
}

}  // namespace

bool slows_for(const StatusMessage& self, const StatusMessage& mate, double age_s,
               const RightOfWayParams& params) {
  if (mate.way_map.empty()) return false;
  const double moved_m = params.speed_mps * std::max(0.0, age_s);
  const Vector2 at = self.T_map_base.inverse() * mate.T_map_base.translation();
  if (at.norm() > params.beside_m + moved_m) return false;
  const double clearly_m = params.abreast_m + moved_m;
  if (std::abs(at.x()) <= clearly_m) return mate.robot < self.robot || at.norm() <= moved_m;
  return at.x() > 0.0;
}

const StatusMessage* who_needs_room(const StatusMessage& self, std::span<const StatusMessage* const> mates,
                                    const RightOfWayParams& params) {
  const Vector2 here = self.T_map_base.translation();
  const StatusMessage* found = nullptr;
  for (const StatusMessage* mate : mates) {
    const Vector2 there = mate->T_map_base.translation();
    if (mate->robot == self.robot || (there - here).norm() > params.near_m) continue;
    if (!leads_through(mate->way_map, here, params.room_m)) continue;
    const bool head_on = leads_through(self.way_map, there, params.room_m);
    const bool makes_room = self.way_map.empty() || (head_on && mate->robot < self.robot);
    if (makes_room && (found == nullptr || mate->robot < found->robot)) found = mate;
  }
  return found;
}

std::optional<grid::CellIndex> room_beside(const grid::DenseMap& map, const grid::TravelField& field,
                                           const StatusMessage& mate,
                                           std::span<const StatusMessage* const> mates, double search_m,
                                           const RightOfWayParams& params) {
  const auto reach = static_cast<std::int32_t>(std::ceil(search_m / map.resolution_m));
  std::optional<grid::CellIndex> best;
  float best_m = static_cast<float>(params.detour_ratio * search_m);
  for (std::int32_t dy = -reach; dy <= reach; dy += params.stride_cells) {
    for (std::int32_t dx = -reach; dx <= reach; dx += params.stride_cells) {
      const grid::CellIndex cell{field.start.x + dx, field.start.y + dy};
      if (!map.contains(cell) || field.cost_m[map.index(cell)] >= best_m) continue;
      if (!field.can_stay_at(map.index(cell))) continue;
      const Vector2 p = map.centre_of(cell);
      if (leads_through(mate.way_map, p, params.room_m)) continue;
      const bool taken = std::any_of(mates.begin(), mates.end(), [&](const StatusMessage* other) {
        return (other->T_map_base.translation() - p).norm() < params.room_m;
      });
      if (taken) continue;
      best = cell;
      best_m = field.cost_m[map.index(cell)];
    }
  }
  return best;
}

}  // namespace topo::team

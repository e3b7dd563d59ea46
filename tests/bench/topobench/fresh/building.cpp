// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/building.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "tests/bench/topobench/fresh/draft.hpp"
#include "tests/bench/topobench/fresh/draw_floor.hpp"
#include "tests/bench/topobench/fresh/draws.hpp"
#include "tests/sim/area.hpp"

namespace topo::bench::fresh {
namespace {

constexpr int kDrafts = 100;
constexpr std::uint64_t kDraftStream = 31;
constexpr double kSure_m = 0.35;   // a disc that gets where the drawn starts of a table are (table_world.hpp)
constexpr double kReach_m = 0.75;  // floor so near to a place of the robot counts as reached
constexpr double kReachedShare = 0.6;  // of a room's floor
constexpr std::size_t kSpacesMin = 8;  // fewer are no floor to explore
constexpr double kStartRoom_m = 0.6;
constexpr double kMateRoom_m = 0.5, kMateApart_m = 1.3;

/// Room for three: at the pose and at two of four places before and behind it.
bool has_team_room(const sim::Raster& free, const std::vector<float>& clearance, const sim::Se2& pose) {
  const auto room_at = [&](double ahead_m) {
    const sim::Vector2 p = pose * sim::Vector2(ahead_m, 0.0);
    const int x = free.column(p.x()), y = free.row(p.y());
    return free.inside(x, y) ? static_cast<double>(clearance[free.index(x, y)]) : 0.0;
  };
  if (room_at(0.0) < kStartRoom_m) return false;
  int mates = 0;
  for (const double side : {-1.0, 1.0}) {
    for (int k = 1; k <= 2; ++k) {
      bool is_clear = true;
      for (double s = 0.0; s <= k * kMateApart_m; s += 0.1)
        is_clear = is_clear && room_at(side * s) >= kMateRoom_m;
      mates += is_clear ? 1 : 0;
    }
  }
  return mates >= 2;
}

/// In one of the corridors, else in a hall, on its middle line and along it.
std::optional<sim::Se2> start_in(const FloorPlan& plan, const sim::Raster& free, sim::Random& random) {
  const std::vector<float> clearance = sim::clearance_m(free);
  for (const Use use : {Use::kCorridor, Use::kHall, Use::kRoom}) {
    std::vector<std::pair<const Wing*, Box>> places;
    for (const Wing& wing : plan.wings) {
      for (const Space& space : wing.spaces) {
        if (space.use == use) places.emplace_back(&wing, floor_of(space, wing.wall_m));
      }
    }
    for (int i = 0; i < 200 && !places.empty(); ++i) {
      const auto& [wing, box] = places[one_of(random, places.size())];
      const bool along_x = box.width() >= box.height();
      const double along = random.uniform(0.05, 0.95);
      const sim::Se2 in_wing =
          along_x ? sim::Se2{box.x0 + along * box.width(), 0.5 * (box.y0 + box.y1), 0.0}
                  : sim::Se2{0.5 * (box.x0 + box.x1), box.y0 + along * box.height(), 0.5 * std::numbers::pi};
      const sim::Se2 pose = wing->T_building_wing * in_wing;
      if (has_team_room(free, clearance, pose)) return pose;
    }
  }
  return std::nullopt;
}

/// The cells that hang together with the start over their sides: a disc of half a cell fits wherever it is
/// free.
sim::Raster connected(const sim::Raster& free, const sim::Vector2& start) {
  return sim::reachable_poses(free, start, 0.5 * free.resolution_m);
}

/// Floor within kReach_m of where the robot's disc gets.
std::vector<bool> reached_floor(const sim::Raster& free, const sim::Vector2& start, double radius_m) {
  sim::Raster away = sim::reachable_poses(free, start, radius_m);
  for (std::uint8_t& cell : away.cells) cell = cell == 0 ? 1 : 0;
  const std::vector<float> distance = sim::clearance_m(away);
  std::vector<bool> reached(distance.size());
  for (std::size_t i = 0; i < reached.size(); ++i) reached[i] = static_cast<double>(distance[i]) <= kReach_m;
  return reached;
}

/// Spaces that a robot does not get into, or of which it sees too little.
std::set<std::pair<std::size_t, std::size_t>> shut_spaces(const FloorPlan& plan, const sim::Raster& free,
                                                          const sim::Vector2& start) {
  const std::vector<bool> reached = reached_floor(free, start, kSure_m);
  std::set<std::pair<std::size_t, std::size_t>> shut;
  for (const SpaceCells& space : cells_of_spaces(plan, free)) {
    const auto n =
        std::count_if(space.cells.begin(), space.cells.end(), [&](std::size_t i) { return reached[i]; });
    if (static_cast<double>(n) < kReachedShare * static_cast<double>(space.cells.size()) ||
        space.cells.empty())
      shut.emplace(space.wing, space.space);
  }
  return shut;
}

void clear_out(FloorPlan& plan, const std::set<std::pair<std::size_t, std::size_t>>& spaces) {
  for (std::size_t w = 0; w < plan.wings.size(); ++w)
    std::erase_if(plan.wings[w].pieces, [&](const Piece& piece) {
      return spaces.contains({w, piece.space});
    });
}

/// Closes what a robot cannot get into even when it is empty.
void close(FloorPlan& plan, const std::set<std::pair<std::size_t, std::size_t>>& spaces) {
  for (const auto& [w, s] : spaces) {
    Wing& wing = plan.wings[w];
    wing.spaces[s].use = Use::kClosed;
    std::erase_if(wing.doors, [space = s](const Door& door) { return door.a == space || door.b == space; });
  }
}

std::size_t open_spaces(const FloorPlan& plan) {
  std::size_t n = 0;
  for (const Wing& wing : plan.wings) {
    for (const Space& space : wing.spaces) n += space.use != Use::kClosed ? 1U : 0U;
  }
  return n;
}

std::optional<Building> finished(FloorPlan plan, sim::Random& random) {
  if (open_spaces(plan) < kSpacesMin) return std::nullopt;
  sim::Raster free = draw_floor(plan);
  const auto start = start_in(plan, free, random);
  if (!start) return std::nullopt;
  auto shut = shut_spaces(plan, free, start->translation());
  // First without the furniture of those rooms, then without them.
  for (int i = 0; i < 2 && !shut.empty(); ++i) {
    i == 0 ? clear_out(plan, shut) : close(plan, shut);
    free = draw_floor(plan);
    shut = shut_spaces(plan, free, start->translation());
  }
  if (!shut.empty()) return std::nullopt;
  free = connected(free, start->translation());
  const double area_m2 = free.area_m2();
  if (area_m2 < kAreaMin_m2 || area_m2 > kAreaMax_m2) return std::nullopt;
  return Building{std::move(plan), std::move(free), *start};
}

}  // namespace

types::Result<Building> draw_building(std::uint64_t seed) {
  for (int draft = 0; draft < kDrafts; ++draft) {
    sim::Random random(sim::derive_seed(seed, kDraftStream, static_cast<std::uint64_t>(draft)));
    auto building = finished(moved_to_origin(draft_plan(random)), random);
    if (building) return std::move(*building);
  }
  return types::fail(
      types::Errc::kInvalidInput,
      fmt::format("seed {}: none of {} drafts is a building of {:g} to {:g} m2 that a robot gets "
                  "through, expected one",
                  seed, kDrafts, kAreaMin_m2, kAreaMax_m2));
}

}  // namespace topo::bench::fresh

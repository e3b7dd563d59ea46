// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/room_floor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/bench/topobench/fresh/draws.hpp"

namespace topo::bench::fresh {
namespace {

constexpr double kBeforeDoor_m = 1.3;  // what is kept free on both sides
constexpr double kBesideDoor_m = 0.15;
constexpr double kFoot_m = 0.05;
constexpr double kTiny_m = 1e-6;

Box before(const Door& door) {
  const Box& g = door.gap;
  return door.along_x
             ? Box{g.x0 - kBeforeDoor_m, g.y0 - kBesideDoor_m, g.x1 + kBeforeDoor_m, g.y1 + kBesideDoor_m}
             : Box{g.x0 - kBesideDoor_m, g.y0 - kBeforeDoor_m, g.x1 + kBesideDoor_m, g.y1 + kBeforeDoor_m};
}

Box box_of(const sim::Polygon& outline) {
  const types::Rectangle box = sim::bounds(outline);
  return {box.min.x(), box.min.y(), box.max.x(), box.max.y()};
}

}  // namespace

RoomFloor::RoomFloor(Wing& wing, std::size_t space)
    : wing_(wing), space_(space), box_(floor_of(wing.spaces[space], wing.wall_m)) {
  for (const Door& door : wing.doors) {
    if (door.a == space || door.b == space) kept_free_.push_back(before(door));
  }
}

bool RoomFloor::is_free(const Box& piece) const {
  const Box inner = grown(piece, -kTiny_m);
  if (piece.x0 < box_.x0 - kTiny_m || piece.y0 < box_.y0 - kTiny_m || piece.x1 > box_.x1 + kTiny_m ||
      piece.y1 > box_.y1 + kTiny_m)
    return false;
  const auto hits = [&](const Box& other) { return overlap(inner, other); };
  return std::none_of(kept_free_.begin(), kept_free_.end(), hits) &&
         std::none_of(taken_.begin(), taken_.end(), hits);
}

bool RoomFloor::put(const Box& piece) { return put(corners(piece)); }

bool RoomFloor::put(const sim::Polygon& outline) {
  const Box box = box_of(outline);
  if (!is_free(box)) return false;
  taken_.push_back(box);
  wing_.pieces.push_back({outline, space_});
  return true;
}

void RoomFloor::put_chair(const sim::Vector2& at, sim::Random& random) {
  constexpr double kRound = 0.3;  // of chairs
  const double radius_m = random.uniform(0.18, 0.26);
  if (happens(random, kRound)) {
    put(sim::make_cylinder(at, radius_m, 0.0, 1.0).outline);
    return;
  }
  if (!is_free({at.x() - radius_m, at.y() - radius_m, at.x() + radius_m, at.y() + radius_m})) return;
  const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
  const int feet = happens(random, 0.5) ? 4 : 5;
  for (int i = 0; i < feet; ++i) {
    const double angle = turn + 2.0 * std::numbers::pi * i / feet;
    const double x = at.x() + radius_m * std::cos(angle), y = at.y() + radius_m * std::sin(angle);
    put(Box{x - 0.5 * kFoot_m, y - 0.5 * kFoot_m, x + 0.5 * kFoot_m, y + 0.5 * kFoot_m});
  }
}

bool RoomFloor::put_table(const Box& table, bool legs) {
  if (!legs) return put(table);
  if (!is_free(table)) return false;
  constexpr double kLeg_m = 0.1;
  for (const double x : {table.x0, table.x1 - kLeg_m}) {
    for (const double y : {table.y0, table.y1 - kLeg_m}) put(Box{x, y, x + kLeg_m, y + kLeg_m});
  }
  taken_.push_back(table);
  return true;
}

Box at_wall(const Box& room, int wall, double along_m, double length_m, double depth_m) {
  switch (wall % 4) {
    case 0:
      return {room.x0 + along_m, room.y0, room.x0 + along_m + length_m, room.y0 + depth_m};
    case 1:
      return {room.x1 - depth_m, room.y0 + along_m, room.x1, room.y0 + along_m + length_m};
    case 2:
      return {room.x0 + along_m, room.y1 - depth_m, room.x0 + along_m + length_m, room.y1};
    default:
      return {room.x0, room.y0 + along_m, room.x0 + depth_m, room.y0 + along_m + length_m};
  }
}

double wall_length_m(const Box& room, int wall) { return wall % 2 == 0 ? room.width() : room.height(); }

}  // namespace topo::bench::fresh

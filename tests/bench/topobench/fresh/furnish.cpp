// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/furnish.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/bench/topobench/fresh/draws.hpp"
#include "tests/bench/topobench/fresh/room_floor.hpp"

namespace topo::bench::fresh {
namespace {

struct Decorator {
  const Furnishing& style;
  sim::Random& random;

  int pieces(double area_m2, double m2_each) const {
    return static_cast<int>(std::lround(style.density * area_m2 / m2_each));
  }

  /// Along a wall drawn anew: cupboards, shelves, boxes.
  void cupboards(RoomFloor& room, int n) {
    for (int i = 0; i < n; ++i) {
      const int wall = static_cast<int>(one_of(random, 4));
      const double length_m = length_of(random, 0.6, 2.4), depth_m = length_of(random, 0.35, 0.55);
      const double play_m = wall_length_m(room.box(), wall) - length_m;
      if (play_m > 0.0)
        room.put(at_wall(room.box(), wall, snapped(play_m * random.uniform()), length_m, depth_m));
    }
  }

  /// Desks at walls, each with a chair.
  void office(RoomFloor& room) {
    for (int i = pieces(room.box().area_m2(), 10.0); i > 0; --i) {
      const int wall = static_cast<int>(one_of(random, 4));
      const double length_m = length_of(random, 1.2, 1.8), depth_m = length_of(random, 0.65, 0.85);
      const double play_m = wall_length_m(room.box(), wall) - length_m;
      if (play_m <= 0.0) continue;
      const double along_m = snapped(play_m * random.uniform());
      const Box desk = at_wall(room.box(), wall, along_m, length_m, depth_m);
      if (!room.put_table(desk, style.legs)) continue;
      const Box seat = at_wall(room.box(), wall, along_m + 0.5 * length_m, 0.0, depth_m + 0.35);
      const sim::Vector2 at = wall == 0   ? sim::Vector2(seat.x0, seat.y1)
                              : wall == 1 ? sim::Vector2(seat.x0, seat.y0)
                              : wall == 2 ? sim::Vector2(seat.x0, seat.y0)
                                          : sim::Vector2(seat.x1, seat.y0);
      room.put_chair(at, random);
    }
    cupboards(room, pieces(room.box().area_m2(), 12.0));
  }

  /// One long table with chairs around it.
  void meeting(RoomFloor& room) {
    const Box& b = room.box();
    const double length_m = snapped(std::min(std::max(b.width(), b.height()) - 2.6, 5.0));
    const double width_m = snapped(std::min(std::min(b.width(), b.height()) - 2.4, 1.4));
    if (length_m < 1.2 || width_m < 0.7) return office(room);
    const bool lies = b.width() >= b.height();
    const double w = lies ? length_m : width_m, h = lies ? width_m : length_m;
    const double x = snapped(b.x0 + 0.5 * (b.width() - w)), y = snapped(b.y0 + 0.5 * (b.height() - h));
    const Box table{x, y, x + w, y + h};
    if (!room.put_table(table, style.legs)) return;
    for (double at_m = 0.4; at_m < length_m - 0.2; at_m += 0.75) {
      room.put_chair(lies ? sim::Vector2(x + at_m, y - 0.3) : sim::Vector2(x - 0.3, y + at_m), random);
      room.put_chair(lies ? sim::Vector2(x + at_m, y + h + 0.3) : sim::Vector2(x + w + 0.3, y + at_m),
                     random);
    }
  }

  /// Rows of tables or benches across the room, with ways between and beside them.
  void rows(RoomFloor& room, double depth_m, double way_m, bool chairs) {
    const Box& b = room.box();
    const bool along_x = b.width() >= b.height();
    const double across_m = along_x ? b.height() : b.width(), length_m = along_x ? b.width() : b.height();
    const bool at_one_wall = happens(random, 0.4);
    const double begin_m = at_one_wall ? 0.0 : 1.0, end_m = across_m - 1.1;
    if (end_m - begin_m < 1.2) return office(room);
    for (double at_m = 1.4; at_m + depth_m + 1.0 < length_m; at_m = snapped(at_m + depth_m + way_m)) {
      const Box row = along_x ? Box{b.x0 + at_m, b.y0 + begin_m, b.x0 + at_m + depth_m, b.y0 + end_m}
                              : Box{b.x0 + begin_m, b.y0 + at_m, b.x0 + end_m, b.y0 + at_m + depth_m};
      if (!room.put_table(row, style.legs && chairs)) continue;
      for (double seat_m = begin_m + 0.4; chairs && seat_m < end_m; seat_m += 0.8)
        room.put_chair(
            along_x ? sim::Vector2(row.x0 - 0.3, b.y0 + seat_m) : sim::Vector2(b.x0 + seat_m, row.y0 - 0.3),
            random);
    }
  }

  /// Walls of stalls, open in front.
  void stalls(RoomFloor& room) {
    const int wall = static_cast<int>(one_of(random, 4));
    for (double at_m = 1.0; at_m + 1.0 < wall_length_m(room.box(), wall); at_m += 1.0)
      room.put(at_wall(room.box(), wall, at_m, 0.1, 1.3));
  }

  /// Half-high walls around places to work.
  void cubicles(RoomFloor& room) {
    const Box& b = room.box();
    constexpr double kSide_m = 2.4, kWay_m = 1.6, kThick_m = 0.1;
    for (double y = b.y0 + 1.4; y + kSide_m + 1.0 < b.y1; y += kSide_m + kWay_m) {
      for (double x = b.x0 + 1.4; x + kSide_m + 1.0 < b.x1; x += kSide_m) {
        const double sx = snapped(x), sy = snapped(y);
        room.put(Box{sx, sy, sx + kThick_m, sy + kSide_m});
        room.put(Box{sx + kThick_m, sy, sx + kSide_m, sy + kThick_m});
        if (happens(random, 0.8)) room.put_table({sx + 0.3, sy + kThick_m, sx + 1.7, sy + 0.8}, style.legs);
        room.put_chair({sx + 1.0, sy + 1.15}, random);
      }
    }
  }

  void pillars(RoomFloor& room) {
    const Box& b = room.box();
    const double pitch_m = length_of(random, 4.0, 7.0), side_m = length_of(random, 0.3, 0.7);
    const bool is_round = happens(random, 0.3);
    for (double y = b.y0 + 0.6 * pitch_m; y + side_m + 1.0 < b.y1; y = snapped(y + pitch_m)) {
      for (double x = b.x0 + 0.6 * pitch_m; x + side_m + 1.0 < b.x1; x = snapped(x + pitch_m)) {
        const double sx = snapped(x), sy = snapped(y);
        if (is_round)
          room.put(sim::make_cylinder({sx, sy}, 0.5 * side_m, 0.0, 2.5).outline);
        else
          room.put(Box{sx, sy, sx + side_m, sy + side_m});
      }
    }
  }

  /// Stands, counters, groups of seats, as they come.
  void exhibits(RoomFloor& room) {
    const Box& b = room.box();
    for (int i = pieces(b.area_m2(), 28.0); i > 0; --i) {
      const double w = length_of(random, 0.4, 3.0), h = length_of(random, 0.4, 1.6);
      const double play_x = b.width() - w - 2.0, play_y = b.height() - h - 2.0;
      if (play_x <= 0.0 || play_y <= 0.0) continue;
      const sim::Vector2 at(b.x0 + 1.0 + play_x * random.uniform(), b.y0 + 1.0 + play_y * random.uniform());
      if (happens(random, 0.3)) {
        for (int seat = 0; seat < 5; ++seat)
          room.put_chair(at + sim::Vector2(random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9)), random);
      } else if (happens(random, 0.3)) {
        room.put(
            sim::make_box({at.x(), at.y(), random.uniform(0.0, std::numbers::pi)}, w, h, 0.0, 1.0).outline);
      } else {
        room.put(Box{snapped(at.x()), snapped(at.y()), snapped(at.x()) + w, snapped(at.y()) + h});
      }
    }
  }

  void pilasters(RoomFloor& room) {
    const double pitch_m = length_of(random, 2.4, 3.6);
    for (const int wall : {0, 2}) {
      for (double at_m = 0.5 * pitch_m; at_m + 0.5 < wall_length_m(room.box(), wall);
           at_m = snapped(at_m + pitch_m))
        room.put(at_wall(room.box(), wall, snapped(at_m), 0.3, 0.15));
    }
  }

  void corridor(RoomFloor& room) {
    const Box& b = room.box();
    const double width_m = std::min(b.width(), b.height());
    if (width_m < 1.9) return;
    const int side = b.width() >= b.height() ? 0 : 1;
    for (int i = pieces(b.area_m2(), 25.0); i > 0; --i) {
      const int wall = side + 2 * static_cast<int>(one_of(random, 2));
      const double length_m = length_of(random, 0.4, 1.8),
                   depth_m = length_of(random, 0.25, std::min(0.5, width_m - 1.5));
      const double play_m = wall_length_m(b, wall) - length_m - 3.0;
      if (play_m > 0.0)
        room.put(at_wall(b, wall, snapped(1.5 + play_m * random.uniform()), length_m, depth_m));
    }
  }

  void hall(RoomFloor& room) {
    const double area_m2 = room.box().area_m2();
    if (area_m2 > 80.0 && happens(random, 0.5)) pillars(room);
    if (!happens(random, style.furnished)) return;
    switch (one_of(random, 4)) {
      case 0:
        return rows(room, length_of(random, 0.5, 0.8), length_of(random, 1.3, 1.8), true);
      case 1:
        return rows(room, length_of(random, 0.8, 1.3), length_of(random, 1.5, 2.4), false);
      case 2:
        return cubicles(room);
      default:
        return exhibits(room);
    }
  }

  void small_room(RoomFloor& room) {
    if (!happens(random, style.furnished)) return;
    const double area_m2 = room.box().area_m2(), kind = random.uniform();
    if (area_m2 < 8.0 && kind < 0.5) return cupboards(room, 2);
    if (area_m2 < 25.0 && kind < 0.12) return stalls(room);
    if (area_m2 > 16.0 && kind < 0.35) return meeting(room);
    if (area_m2 > 24.0 && kind < 0.6)
      return rows(room, length_of(random, 0.5, 1.0), length_of(random, 1.3, 1.8), happens(random, 0.5));
    office(room);
  }
};

}  // namespace

Furnishing furnishing_of(sim::Random& random) {
  Furnishing style;
  style.furnished = happens(random, 0.25) ? 0.1 : random.uniform(0.3, 0.9);
  style.density = random.uniform(0.5, 1.5);
  style.pilasters = happens(random, 0.3);
  style.legs = happens(random, 0.4);
  return style;
}

void furnish(Wing& wing, const Furnishing& furnishing, sim::Random& random) {
  Decorator decorator{furnishing, random};
  for (std::size_t i = 0; i < wing.spaces.size(); ++i) {
    RoomFloor room(wing, i);
    if (furnishing.pilasters && (wing.spaces[i].use == Use::kRoom || wing.spaces[i].use == Use::kHall))
      decorator.pilasters(room);
    if (wing.spaces[i].use == Use::kCorridor) decorator.corridor(room);
    if (wing.spaces[i].use == Use::kHall) decorator.hall(room);
    if (wing.spaces[i].use == Use::kRoom) decorator.small_room(room);
  }
}

}  // namespace topo::bench::fresh

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/doors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/bench/topobench/fresh/draws.hpp"

namespace topo::bench::fresh {
namespace {

constexpr double kJamb_m = 0.1;  // of wall beside a door, at least
constexpr double kSame_m = 1e-6;
constexpr double kBesideCorner = 0.6;  // of doors: near to the end of their wall

/// Sets of spaces between which one can go.
class Joined {
 public:
  explicit Joined(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  bool join(std::size_t a, std::size_t b) {
    const std::size_t ra = root(a), rb = root(b);
    parent_[ra] = rb;
    return ra != rb;
  }

 private:
  std::vector<std::size_t> parent_;
};

void add_shared(const Wing& wing, std::size_t a, std::size_t b, std::vector<SharedWall>& out) {
  const Space &first = wing.spaces[a], &second = wing.spaces[b];
  if (first.use == Use::kClosed || second.use == Use::kClosed) return;
  const Box f = floor_of(first, wing.wall_m), s = floor_of(second, wing.wall_m);
  SharedWall wall{a, b, true, second.box.x0, std::max(f.y0, s.y0), std::min(f.y1, s.y1)};
  if (std::abs(first.box.x1 - second.box.x0) < kSame_m) {
    if (wall.length_m() >= kDoorMin_m + 2.0 * kJamb_m) out.push_back(wall);
  } else if (std::abs(first.box.y1 - second.box.y0) < kSame_m) {
    wall = {a, b, false, second.box.y0, std::max(f.x0, s.x0), std::min(f.x1, s.x1)};
    if (wall.length_m() >= kDoorMin_m + 2.0 * kJamb_m) out.push_back(wall);
  }
}

class Carpenter {
 public:
  Carpenter(Wing& wing, const DoorRules& rules, sim::Random& random)
      : wing_(wing),
        rules_(rules),
        random_(random),
        walls_(shared_walls(wing)),
        joined_(wing.spaces.size()) {}

  void work() {
    for (const SharedWall& wall : walls_) {
      if (count(wall, Use::kCorridor) == 2) join_corridors(wall);
    }
    for (std::size_t i = 0; i < wing_.spaces.size(); ++i) {
      const Use use = wing_.spaces[i].use;
      if (use == Use::kRoom || use == Use::kHall) open_to_corridors(i);
    }
    for (const SharedWall& wall : walls_) {
      if (count(wall, Use::kCorridor) == 0 && happens(random_, rules_.connecting)) add(wall);
    }
    connect_all();
    close_what_is_left();
  }

 private:
  [[nodiscard]] int count(const SharedWall& wall, Use use) const {
    return (wing_.spaces[wall.a].use == use ? 1 : 0) + (wing_.spaces[wall.b].use == use ? 1 : 0);
  }

  double width_of(const SharedWall& wall) {
    double width_m = length_of(random_, 0.8, 1.35);
    if (count(wall, Use::kHall) > 0 || count(wall, Use::kCorridor) == 2)
      width_m = length_of(random_, 1.2, kDoorMax_m);
    else if (happens(random_, rules_.narrow))
      width_m = length_of(random_, kDoorMin_m, 0.8);
    return std::clamp(width_m, kDoorMin_m, snapped(wall.length_m() - 2.0 * kJamb_m));
  }

  void add(const SharedWall& wall) { add(wall, width_of(wall)); }
  void add(const SharedWall& wall, double width_m) {
    const double play_m = wall.length_m() - width_m - 2.0 * kJamb_m;
    double at_m = play_m * random_.uniform();
    if (happens(random_, kBesideCorner))
      at_m = random_.uniform() < 0.5 ? std::min(play_m, 0.15) : std::max(0.0, play_m - 0.15);
    put(wall, snapped(wall.from_m + kJamb_m + at_m), width_m);
  }
  void put(const SharedWall& wall, double from_m, double width_m) {
    const double w0 = wall.wall_at_m, w1 = w0 + wing_.wall_m;
    const Box gap =
        wall.along_x ? Box{w0, from_m, w1, from_m + width_m} : Box{from_m, w0, from_m + width_m, w1};
    wing_.doors.push_back({wall.a, wall.b, gap, wall.along_x});
    joined_.join(wall.a, wall.b);
  }

  /// All of what they share is open, or a wide door is in it.
  void join_corridors(const SharedWall& wall) {
    const bool has_door = wall.length_m() > 1.4 && happens(random_, rules_.fire_door);
    if (has_door)
      add(wall);
    else
      put(wall, wall.from_m, wall.length_m());
  }

  void open_to_corridors(std::size_t space) {
    std::vector<const SharedWall*> corridors;
    for (const SharedWall& wall : walls_) {
      if ((wall.a == space || wall.b == space) && count(wall, Use::kCorridor) == 1)
        corridors.push_back(&wall);
    }
    if (corridors.empty()) return;
    if (wing_.spaces[space].use == Use::kHall ? happens(random_, rules_.lobby)
                                              : happens(random_, rules_.alcove)) {
      const SharedWall& wall = *corridors[one_of(random_, corridors.size())];
      return put(wall, wall.from_m, wall.length_m());
    }
    const std::size_t first = one_of(random_, corridors.size());
    const bool is_large = wing_.spaces[space].box.area_m2() > 45.0;
    for (std::size_t i = 0; i < corridors.size(); ++i) {
      if (i == first || happens(random_, rules_.second)) add(*corridors[i]);
      if (i == first && is_large && corridors[i]->length_m() > 8.0 && happens(random_, 0.6))
        add_far(*corridors[i]);
    }
  }
  /// A second door in a wall, in the half that has none.
  void add_far(const SharedWall& wall) {
    const Door& first = wing_.doors.back();
    const double middle_m = 0.5 * (wall.from_m + wall.to_m);
    SharedWall half = wall;
    (wall.along_x ? first.gap.y0 : first.gap.x0) < middle_m ? half.from_m = snapped(middle_m + 1.0)
                                                            : half.to_m = snapped(middle_m - 1.0);
    if (half.length_m() > kDoorMax_m + 2.0 * kJamb_m) add(half);
  }

  void connect_all() {
    std::vector<const SharedWall*> order;
    for (const SharedWall& wall : walls_) order.push_back(&wall);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[one_of(random_, i)]);
    for (const SharedWall* wall : order) {
      if (joined_.root(wall->a) != joined_.root(wall->b)) add(*wall);
    }
  }

  void close_what_is_left() {
    std::vector<double> area_m2(wing_.spaces.size(), 0.0);
    for (std::size_t i = 0; i < wing_.spaces.size(); ++i) {
      if (wing_.spaces[i].use != Use::kClosed) area_m2[joined_.root(i)] += wing_.spaces[i].box.area_m2();
    }
    const auto largest =
        static_cast<std::size_t>(std::max_element(area_m2.begin(), area_m2.end()) - area_m2.begin());
    for (std::size_t i = 0; i < wing_.spaces.size(); ++i) {
      if (joined_.root(i) != largest) wing_.spaces[i].use = Use::kClosed;
    }
    std::erase_if(wing_.doors, [&](const Door& door) { return joined_.root(door.a) != largest; });
  }

  Wing& wing_;
  const DoorRules& rules_;
  sim::Random& random_;
  std::vector<SharedWall> walls_;
  Joined joined_;
};

}  // namespace

std::vector<SharedWall> shared_walls(const Wing& wing) {
  std::vector<SharedWall> walls;
  for (std::size_t a = 0; a < wing.spaces.size(); ++a) {
    for (std::size_t b = 0; b < wing.spaces.size(); ++b) {
      if (a != b) add_shared(wing, a, b, walls);
    }
  }
  return walls;
}

void add_leaves(Wing& wing, double share, sim::Random& random) {
  constexpr double kLeafMax_m = 1.15;
  for (const Door& door : wing.doors) {
    if (door.width_m() > kLeafMax_m || wing.spaces[door.b].use == Use::kCorridor || !happens(random, share))
      continue;
    const Box& g = door.gap;
    const Box leaf = door.along_x ? Box{g.x1, g.y0 - kCell_m, g.x1 + door.width_m(), g.y0}
                                  : Box{g.x0 - kCell_m, g.y1, g.x0, g.y1 + door.width_m()};
    wing.pieces.push_back({corners(leaf), door.b});
  }
}

void add_doors(Wing& wing, const DoorRules& rules, sim::Random& random) {
  Carpenter(wing, rules, random).work();
}

}  // namespace topo::bench::fresh

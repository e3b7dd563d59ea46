// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/bound/bound.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "tests/sim/area.hpp"

namespace topo::bench::bound {
namespace {

constexpr double kRadius_m = 0.267;
constexpr double kShare = 0.99;
constexpr std::size_t kPlacesMax = 6;

/// A building by its walls, each a list of points.
std::string scene(const sim::Vector2& start, const std::vector<std::string>& walls) {
  std::string text = fmt::format("name = \"small\"\n[[start]]\nx_m = {}\ny_m = {}\n", start.x(), start.y());
  for (const std::string& points : walls)
    text += fmt::format("[[wall]]\npoints_m = [{}]\nthickness_m = 0.2\n", points);
  return text;
}

/// Two rooms, a door of 1 m between them.
std::string two_rooms() {
  return scene({1.0, 1.0}, {"[0.0, 0.0], [8.0, 0.0], [8.0, 4.0], [0.0, 4.0], [0.0, 0.0]",
                            "[4.0, 0.0], [4.0, 2.5]", "[4.0, 3.5], [4.0, 4.0]"});
}
/// A corridor that bends twice.
std::string bent_corridor() {
  return scene({0.8, 0.8}, {"[0.0, 0.0], [7.0, 0.0], [7.0, 6.0], [12.0, 6.0], [12.0, 7.6], [5.4, 7.6], [5.4, "
                            "1.6], [0.0, 1.6], [0.0, 0.0]"});
}
/// A corridor with an arm at each end, the start in its middle.
std::string two_arms() {
  return scene({10.0, 0.8}, {"[0.0, 0.0], [20.0, 0.0], [20.0, 8.0], [18.4, 8.0], [18.4, 1.6], [1.6, 1.6], "
                             "[1.6, 8.0], [0.0, 8.0], [0.0, 0.0]"});
}
/// A corridor around a block.
std::string ring() {
  return scene({0.8, 0.8}, {"[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0], [0.0, 0.0]",
                            "[1.6, 1.6], [6.4, 1.6], [6.4, 6.4], [1.6, 6.4], [1.6, 1.6]"});
}

struct Small {
  explicit Small(const std::string& text, double spacing_m)
      : world(*sim::World::from_scene_text(text, "small")),
        start(world.start_poses().front().translation()),
        area(sim::reachable_area(world, start, kRadius_m)) {
    params.spacing_m = spacing_m;
  }
  [[nodiscard]] Bound bound(std::size_t robots) const {
    return find_bound({&world, &area.poses, &area.visible, std::vector<sim::Vector2>(robots, start), {}},
                      params);
  }

  sim::World world;
  sim::Vector2 start;
  sim::ReachableArea area;
  BoundParams params;
};

/// Every order of every choice of the places, and what is seen on the way after each look.
class AllWays {
 public:
  explicit AllWays(const Small& small)
      : small_(small),
        ways_(small.area.poses),
        sight_(small.world, small.area.visible, small.params.sight),
        places_(places_to_look_from(ways_, small.params.spacing_m)),
        wanted_(static_cast<std::size_t>(std::ceil(kShare * static_cast<double>(sight_.cells())))) {
    if (places_.size() > kPlacesMax) return;
    for (const sim::Vector2& place : places_) fields_.push_back(ways_.field_to({&place, 1}));
    const CellSet at_start = sight_.from(small.start);
    note(0.0, at_start);
    extend(small.start, 0.0, at_start, std::vector<bool>(places_.size(), false));
  }

  [[nodiscard]] std::size_t places() const { return places_.size(); }
  /// The least way of the longer of the robots, to the length of a look; infinite: too little is seen.
  [[nodiscard]] double least_m(std::size_t robots) const {
    for (std::size_t step = 0; step < seen_.size(); ++step) {
      for (const CellSet& first : seen_[step]) {
        if (robots == 1 ? first.size() >= wanted_ : any_pair(first, step))
          return static_cast<double>(step) * small_.params.look_m;
      }
    }
    return HUGE_VAL;
  }

 private:
  [[nodiscard]] bool any_pair(const CellSet& first, std::size_t step) const {
    return std::any_of(seen_[step].begin(), seen_[step].end(),
                       [&](const CellSet& second) { return first.size() + second.beyond(first) >= wanted_; });
  }
  void note(double way_m, const CellSet& seen) {
    const auto step = static_cast<std::size_t>(std::ceil(way_m / small_.params.look_m));
    if (seen_.size() <= step) seen_.resize(step + 1);
    seen_[step].push_back(seen);
  }
  void extend(const sim::Vector2& here, double way_m, const CellSet& seen, const std::vector<bool>& used) {
    for (std::size_t p = 0; p < places_.size(); ++p) {
      if (used[p]) continue;
      CellSet now = seen;
      double leg_m = 0.0;
      for (const Look& look : looks_on(ways_.way(fields_[p], here), small_.params.look_m)) {
        now |= sight_.from(look.at);
        leg_m = look.way_m;
        note(way_m + leg_m, now);
      }
      std::vector<bool> with = used;
      with[p] = true;
      extend(places_[p], way_m + leg_m, now, with);
    }
  }

  const Small& small_;
  WayMap ways_;
  Sight sight_;
  std::vector<sim::Vector2> places_;
  std::size_t wanted_;
  std::vector<WayMap::Field> fields_;
  std::vector<std::vector<CellSet>> seen_;  ///< sets that one robot can have seen, by the way driven
};

/// Exact for one robot and for two, in three buildings: the bounds are on their sides of it, and near.
void check(const std::string& text, double spacing_m, std::size_t robots, double longer_at_most) {
  const Small small(text, spacing_m);
  const AllWays all(small);
  ASSERT_LE(all.places(), kPlacesMax) << "small enough to try everything";
  const double exact_m = all.least_m(robots);
  ASSERT_TRUE(std::isfinite(exact_m));
  const Bound bound = small.bound(robots);
  const ShareBound& share = bound.shares.back();
  EXPECT_TRUE(bound.is_feasible);
  EXPECT_LE(share.lower_m, exact_m + small.params.look_m);
  EXPECT_GE(share.way_m, exact_m - small.params.look_m);
  EXPECT_LE(share.way_m, longer_at_most * exact_m + small.params.look_m) << "not far from the best";
}

TEST(Bound, isRightOfTwoRooms) { check(two_rooms(), 3.4, 1, 1.25); }
TEST(Bound, isRightOfABentCorridor) { check(bent_corridor(), 5.0, 1, 1.25); }
TEST(Bound, isRightOfARing) { check(ring(), 4.2, 1, 1.25); }
TEST(Bound, isRightOfTwoRobotsInTwoRooms) { check(two_rooms(), 3.4, 2, 1.35); }
TEST(Bound, isRightOfTwoRobotsInABentCorridor) { check(bent_corridor(), 5.0, 2, 1.35); }

TEST(Bound, isNothingWhereAllIsSeenAtOnce) {
  const Small room(scene({2.0, 2.0}, {"[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [0.0, 4.0], [0.0, 0.0]"}), 0.8);
  EXPECT_DOUBLE_EQ(room.bound(1).shares.back().way_m, 0.0);
  EXPECT_DOUBLE_EQ(room.bound(1).shares.back().lower_m, 0.0);
}

TEST(Bound, isLessForTwoRobotsAndForALesserShare) {
  const Small small(two_arms(), 0.8);
  const Bound one = small.bound(1), two = small.bound(2);
  EXPECT_LT(two.shares.back().way_m, 0.6 * one.shares.back().way_m);
  EXPECT_LE(one.shares[0].way_m, one.shares[2].way_m);
  EXPECT_LE(one.shares[0].lower_m, one.shares[2].lower_m);
  EXPECT_GT(one.shares[2].lower_m, 0.3 * one.shares[2].way_m) << "the lower one says something";
}

TEST(GreedyCover, takesWhatAddsMost) {
  std::vector<CellSet> sets(3, CellSet(10));
  for (const std::size_t cell : {0U, 1U}) sets[0].insert(cell);
  for (const std::size_t cell : {1U, 2U, 3U}) sets[1].insert(cell);
  for (const std::size_t cell : {2U, 3U, 4U, 5U, 6U}) sets[2].insert(cell);
  EXPECT_EQ(greedy_cover(sets, 7), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(greedy_cover(sets, 10), (std::vector<std::size_t>{0, 2})) << "the last adds nothing";
  const std::vector<double> costs{1.0, 1.0, 9.0};
  EXPECT_EQ(greedy_cover(sets, 4, costs), (std::vector<std::size_t>{0, 1})) << "the other costs too much";
}

TEST(DriveTime, isThatOfRampsAndTurns) {
  types::DriveLimits limits;
  limits.v_max_mps = 0.5, limits.acceleration_mps2 = 0.5, limits.deceleration_mps2 = 0.5;
  limits.omega_max_radps = 1.0, limits.angular_acceleration_radps2 = 1.0;
  EXPECT_NEAR(drive_time_s({{0.0, 0.0}, {2.0, 0.0}}, limits), 5.0, 1e-9)
      << "0.5 m of ramps in 2 s, 1.5 m in 3 s";
  EXPECT_NEAR(drive_time_s({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.2}}, limits),
              drive_time_s({{0.0, 0.0}, {1.0 + std::hypot(1.0, 0.2), 0.0}}, limits), 1e-9)
      << "a slight bend is driven through";
  EXPECT_NEAR(drive_time_s({{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}}, limits), 5.0 + 5.0 + 1.0 + 0.5 * M_PI, 1e-9);
}

}  // namespace
}  // namespace topo::bench::bound

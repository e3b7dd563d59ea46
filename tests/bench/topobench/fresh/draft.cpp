// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/draft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/bench/topobench/fresh/doors.hpp"
#include "tests/bench/topobench/fresh/draws.hpp"
#include "tests/bench/topobench/fresh/furnish.hpp"
#include "tests/bench/topobench/fresh/layouts.hpp"
#include "tests/bench/topobench/fresh/wings.hpp"

namespace topo::bench::fresh {
namespace {

constexpr double kFootprintMin_m2 = 380.0, kFootprintMax_m2 = 3300.0;
constexpr double kSmall_m2 = 600.0;    // houses are not larger
constexpr double kOneWing_m2 = 450.0;  // nor has anything smaller two wings
constexpr double kWingMin_m = 11.0;

enum class Style : std::uint8_t { kHouse, kOffice, kRing, kHall };

Style style_of(double area_m2, sim::Random& random) {
  const double draw = random.uniform();
  if (area_m2 < kSmall_m2) return draw < 0.35 ? Style::kHouse : draw < 0.75 ? Style::kOffice : Style::kHall;
  return draw < 0.45 ? Style::kOffice : draw < 0.75 ? Style::kRing : Style::kHall;
}

Box outline_of(Style style, double area_m2, const LayoutRules& rules, sim::Random& random) {
  const double aspect = style == Style::kHall ? random.uniform(1.0, 2.0) : random.uniform(1.0, 3.2);
  double height_m = std::max(std::sqrt(area_m2 / aspect), kWingMin_m);
  if (style == Style::kRing) height_m = std::max(height_m, 2.0 * (rules.strip_m + rules.corridor_m) + 4.0);
  return {0.0, 0.0, snapped(std::max(area_m2 / height_m, kWingMin_m)), snapped(height_m)};
}

struct Taste {
  DoorRules doors;
  Furnishing furnishing;
  double leaves = 0.0;
};

Wing draw_wing(double area_m2, const Taste& taste, sim::Random& random) {
  const Style style = style_of(area_m2, random);
  const LayoutRules rules = style == Style::kHouse ? house_rules(random) : office_rules(random);
  Wing wing;
  wing.wall_m = length_of(random, 0.1, 0.3);
  wing.outline = outline_of(style, area_m2, rules, random);
  wing.spaces = style == Style::kRing   ? ring_layout(wing.outline, rules, random)
                : style == Style::kHall ? hall_layout(wing.outline, rules, random)
                                        : office_layout(wing.outline, rules, random);
  add_doors(wing, taste.doors, random);
  furnish(wing, taste.furnishing, random);
  add_leaves(wing, taste.leaves, random);
  return wing;
}

Taste taste_of(sim::Random& random) {
  Taste taste;
  taste.doors.narrow = random.uniform(0.0, 0.25);
  taste.doors.connecting = random.uniform(0.03, 0.25);
  taste.doors.second = random.uniform(0.1, 0.4);
  taste.doors.fire_door = random.uniform(0.0, 0.4);
  taste.doors.lobby = random.uniform(0.0, 0.5);
  taste.doors.alcove = random.uniform(0.0, 0.12);
  taste.furnishing = furnishing_of(random);
  taste.leaves = happens(random, 0.5) ? random.uniform(0.1, 0.5) : 0.0;
  return taste;
}

}  // namespace

FloorPlan draft_plan(sim::Random& random) {
  const double area_m2 = std::exp(random.uniform(std::log(kFootprintMin_m2), std::log(kFootprintMax_m2)));
  const std::size_t wings =
      area_m2 < kOneWing_m2 ? 1 : 1 + one_of(random, area_m2 < 2.0 * kOneWing_m2 ? 2 : 3);
  const Taste taste = taste_of(random);
  FloorPlan plan;
  double left_m2 = area_m2;
  for (std::size_t i = 0; i < wings; ++i) {
    const double share = i + 1 == wings ? 1.0 : random.uniform(0.4, 0.7);
    Wing wing = draw_wing(share * left_m2, taste, random);
    left_m2 -= share * left_m2;
    if (plan.wings.empty()) {
      wing.T_building_wing.theta_rad = happens(random, 0.35) ? 0.5 * std::numbers::pi : 0.0;
      plan.wings.push_back(std::move(wing));
    } else {
      attach(plan, std::move(wing), random);
    }
  }
  return plan;
}

}  // namespace topo::bench::fresh

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/layouts.hpp"

#include <algorithm>

#include "tests/bench/topobench/fresh/blocks.hpp"
#include "tests/bench/topobench/fresh/draws.hpp"

namespace topo::bench::fresh {
namespace {

constexpr double kCourt = 0.2;       // of cores: closed
constexpr double kOpenCore = 0.25;   // of cores: one hall
constexpr double kBareFacade = 0.2;  // of the sides of a ring: no rooms
constexpr double kHallMin_m = 9.0;

/// A row whose first and last rooms reach beyond the corner, to where the corridor is.
void add_row_with_corners(const Box& box, double corner0_m, double corner1_m, const LayoutRules& rules,
                          sim::Random& random, std::vector<Space>& out) {
  Box middle = box;
  if (corner0_m > 0.0) {
    middle.x0 = snapped(box.x0 + corner0_m + random.uniform(1.6, 2.6));
    out.push_back({{box.x0, box.y0, middle.x0, box.y1}, Use::kRoom});
  }
  if (corner1_m > 0.0) {
    middle.x1 = snapped(box.x1 - corner1_m - random.uniform(1.6, 2.6));
    out.push_back({{middle.x1, box.y0, box.x1, box.y1}, Use::kRoom});
  }
  add_row(middle, true, rules, random, out);
}

void add_core(const Box& core, const LayoutRules& rules, sim::Random& random, std::vector<Space>& out) {
  if (happens(random, kCourt)) {
    out.push_back({core, Use::kClosed});
  } else if (core.area_m2() < 300.0 && happens(random, kOpenCore)) {
    out.push_back({core, Use::kHall});
  } else {
    divide(core, {true, true, true, true}, rules, random, out);
  }
}

}  // namespace

LayoutRules office_rules(sim::Random& random) {
  LayoutRules rules;
  rules.strip_m = length_of(random, 4.0, 7.5);
  rules.corridor_m = length_of(random, 1.6, 2.8);
  rules.room_min_m = length_of(random, 2.6, 4.0);
  rules.room_max_m = rules.room_min_m + length_of(random, 1.5, 5.5);
  rules.modular = happens(random, 0.5);
  rules.closed = random.uniform(0.0, 0.12);
  rules.open_block = random.uniform(0.0, 0.3);
  return rules;
}

LayoutRules house_rules(sim::Random& random) {
  LayoutRules rules;
  rules.strip_m = length_of(random, 3.2, 4.6);
  rules.corridor_m = length_of(random, 1.45, 1.8);
  rules.room_min_m = length_of(random, 2.2, 2.8);
  rules.room_max_m = rules.room_min_m + length_of(random, 1.5, 3.0);
  rules.closed = random.uniform(0.0, 0.05);
  rules.open_block = random.uniform(0.0, 0.3);
  return rules;
}

std::vector<Space> office_layout(const Box& block, const LayoutRules& rules, sim::Random& random) {
  std::vector<Space> spaces;
  divide(block, {}, rules, random, spaces);
  return spaces;
}

std::vector<Space> ring_layout(const Box& block, const LayoutRules& rules, sim::Random& random) {
  std::vector<Space> spaces;
  const auto depth = [&] { return happens(random, kBareFacade) ? 0.0 : rules.strip_m; };
  const double left = depth(), right = depth(), below = depth(), above = depth();
  const double c = rules.corridor_m;
  const Box ring{block.x0 + left, block.y0 + below, block.x1 - right, block.y1 - above};
  if (below > 0.0)
    add_row_with_corners({block.x0, block.y0, block.x1, ring.y0}, left, right, rules, random, spaces);
  if (above > 0.0)
    add_row_with_corners({block.x0, ring.y1, block.x1, block.y1}, left, right, rules, random, spaces);
  if (left > 0.0) add_row({block.x0, ring.y0, ring.x0, ring.y1}, false, rules, random, spaces);
  if (right > 0.0) add_row({ring.x1, ring.y0, block.x1, ring.y1}, false, rules, random, spaces);
  const Box core{ring.x0 + c, ring.y0 + c, ring.x1 - c, ring.y1 - c};
  for (const Box& corridor :
       {Box{ring.x0, ring.y0, ring.x1, core.y0}, Box{ring.x0, core.y1, ring.x1, ring.y1},
        Box{ring.x0, core.y0, core.x0, core.y1}, Box{core.x1, core.y0, ring.x1, core.y1}})
    spaces.push_back({corridor, Use::kCorridor});
  add_core(core, rules, random, spaces);
  return spaces;
}

std::vector<Space> hall_layout(const Box& block, const LayoutRules& rules, sim::Random& random) {
  std::vector<Space> spaces;
  Box rest = block;
  if (block.height() > rules.strip_m + rules.corridor_m + kHallMin_m) {
    const double row_m = block.y0 + rules.strip_m;
    add_row({block.x0, block.y0, block.x1, row_m}, true, rules, random, spaces);
    // A lobby is a wide corridor.
    rest.y0 = snapped(row_m + rules.corridor_m * (happens(random, 0.4) ? random.uniform(1.5, 2.5) : 1.0));
    spaces.push_back({{block.x0, row_m, block.x1, rest.y0}, Use::kCorridor});
  }
  const bool has_offices = rest.width() > 2.0 * kHallMin_m + 2.0 * rules.strip_m && happens(random, 0.5);
  if (has_offices) {
    const double cut = snapped(rest.x1 - rest.width() * random.uniform(0.25, 0.45));
    divide({cut, rest.y0, rest.x1, rest.y1}, {false, false, true, false}, rules, random, spaces);
    rest.x1 = cut;
  }
  while (rest.width() > 2.0 * kHallMin_m && happens(random, 0.75)) {
    const double cut = snapped(rest.x0 + random.uniform(kHallMin_m, rest.width() - kHallMin_m));
    spaces.push_back({{rest.x0, rest.y0, cut, rest.y1}, Use::kHall});
    rest.x0 = cut;
  }
  spaces.push_back({rest, Use::kHall});
  return spaces;
}

}  // namespace topo::bench::fresh

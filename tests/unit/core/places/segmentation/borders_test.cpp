// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/borders.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "core/places/segmentation/wall_sides.hpp"

namespace topo::places {
namespace {

TEST(Borders, AreHandedToBothSidesInRisingOrder) {
  EXPECT_TRUE(rc::check([] {
    const auto count = *rc::gen::inRange<std::uint32_t>(2, 9);
    const double step_m = 0.05 * *rc::gen::inRange(1, 5);
    Borders borders(count);
    std::map<std::pair<std::uint32_t, std::uint32_t>, Borders::Between> expected;
    for (int k = *rc::gen::inRange(0, 40); k > 0; --k) {
      const auto a = *rc::gen::inRange<std::uint32_t>(0, count),
                 b = *rc::gen::inRange<std::uint32_t>(0, count);
      if (a == b) continue;
      for (Borders::Between* const between : {&borders.between(a, b), &expected[std::minmax(a, b)]}) {
        between->upright += a;
        between->level += b;
        between->wall_steps += a + b;
        between->clearance_m = std::max(between->clearance_m, static_cast<float>(k));
      }
    }
    std::vector<Region> regions(count);
    regions[0].contacts.push_back({1, 7, 7, 7.0F, 7.0F, 7.0F});  // gone before
    borders.hand_out(regions, step_m);
    std::size_t contacts = 0;
    for (std::uint32_t r = 0; r < count; ++r) {
      RC_ASSERT(std::ranges::is_sorted(regions[r].contacts, {}, &Contact::other));
      for (const Contact& c : regions[r].contacts) {
        const Borders::Between& between = expected.at(std::minmax(r, c.other));
        RC_ASSERT(c.upright == between.upright && c.level == between.level);
        RC_ASSERT(c.wall_m == wall_length_m(between.wall_steps, step_m) &&
                  c.clearance_m == between.clearance_m);
        RC_ASSERT(c.open == static_cast<float>(std::hypot(c.upright, c.level)));
        ++contacts;
      }
    }
    RC_ASSERT(contacts == 2 * expected.size());
  }));
}

}  // namespace
}  // namespace topo::places

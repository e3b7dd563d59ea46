// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/surfel_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace topo::slam {
namespace {

TEST(SurfelMap, FindsTheNearestToTheCellAsTryingAllDoes) {
  EXPECT_TRUE(rc::check("lookup equals brute force over cell centres", [] {
    SurfelMap map(0.35);
    map.reset({0.0F, 0.0F}, 3.0);
    std::vector<Surfel> surfels;
    for (int i = *rc::gen::inRange(1, 30); i > 0; --i) {
      const auto at = [] { return static_cast<float>(*rc::gen::inRange(-2900, 2900)) / 1000.0F; };
      surfels.push_back({Point(at(), at()), Point(1.0F, 0.0F), true});
    }
    map.add(surfels, {});
    const auto at = [] { return *rc::gen::inRange(-29, 29); };
    const Point centre(static_cast<float>(at()) * 0.1F + 0.05F, static_cast<float>(at()) * 0.1F + 0.05F);
    float best = 0.35F;
    for (const Surfel& s : surfels) best = std::min(best, (s.position - centre).norm());
    const Surfel* found = map.nearest(centre);
    if (found == nullptr) {
      RC_ASSERT(best > 0.349F);
    } else {
      RC_ASSERT(std::abs((found->position - centre).norm() - best) < 1e-4F);
    }
  }));
}

TEST(SurfelMap, MovesSurfelsIntoItsFrame) {
  SurfelMap map(0.35);
  map.reset({10.0F, 0.0F}, 3.0);
  map.add(std::vector<Surfel>{{Point(1.0F, 0.0F), Point(-1.0F, 0.0F), true}},
          {10.0, 0.0, std::numbers::pi / 2});
  ASSERT_EQ(map.surfels().size(), 1U);
  EXPECT_NEAR(map.surfels()[0].position.x(), 10.0F, 1e-5F);
  EXPECT_NEAR(map.surfels()[0].position.y(), 1.0F, 1e-5F);
  EXPECT_NEAR(map.surfels()[0].normal.y(), -1.0F, 1e-5F);
}

TEST(SurfelMap, NothingOutsideItsWindow) {
  SurfelMap map(0.35);
  map.reset({0.0F, 0.0F}, 2.0);
  map.add(std::vector<Surfel>{{Point(5.0F, 0.0F), Point(1.0F, 0.0F), true},
                              {Point(NAN, 0.0F), Point(1.0F, 0.0F), true}},
          {});
  EXPECT_TRUE(map.surfels().empty());
  EXPECT_EQ(map.nearest({5.0F, 0.0F}), nullptr);
  EXPECT_EQ(map.nearest({NAN, NAN}), nullptr);
  EXPECT_EQ(map.nearest({-1e30F, 1e30F}), nullptr);
}

}  // namespace
}  // namespace topo::slam

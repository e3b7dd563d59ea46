// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/surfel_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <random>
#include <vector>

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

std::vector<Surfel> scattered_surfels(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-3.5F, 3.5F);
  std::vector<Surfel> surfels;
  while (surfels.size() < count) {
    const float x = place(random), y = place(random);
    surfels.push_back({Point(x, y), Point(1.0F, 0.0F), surfels.size() % 2 == 0});
  }
  return surfels;
}

/// Place of what is found at the centre of every cell of 0.1 m in a window of 6 m; -1 for nothing.
std::vector<std::ptrdiff_t> found_everywhere(const SurfelMap& map) {
  std::vector<std::ptrdiff_t> found;
  for (int y = -30; y < 30; ++y) {
    for (int x = -30; x < 30; ++x) {
      const Surfel* surfel =
          map.nearest(0.1F * Point(static_cast<float>(x), static_cast<float>(y)) + Point(0.05F, 0.05F));
      found.push_back(surfel == nullptr ? -1 : surfel - map.surfels().data());
    }
  }
  return found;
}

TEST(SurfelMap, WhatIsAddedAfterALookIsFoundAsIfItHadBeenThere) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    const std::vector<Surfel> surfels = scattered_surfels(90, random);
    SurfelMap by_parts(0.35), at_once(0.35);
    by_parts.reset({0.0F, 0.0F}, 3.0);
    at_once.reset({0.0F, 0.0F}, 3.0);
    at_once.add(surfels, {});
    for (std::size_t i = 0; i < surfels.size(); i += 15) {
      by_parts.add(std::span(surfels).subspan(i, 15), {});
      (void)found_everywhere(by_parts);  // and remembered
    }
    EXPECT_EQ(found_everywhere(by_parts), found_everywhere(at_once)) << seed;
  }
}

TEST(SurfelMap, OfSeveralAsNearTheFirstThatWasAddedIsFound) {
  SurfelMap map(0.35);
  map.reset({0.0F, 0.0F}, 2.0);
  const Point centre(0.05F, 0.05F);
  for (const float normal : {1.0F, -1.0F, 1.0F})
    map.add(std::vector<Surfel>{{centre, Point(normal, 0.0F), true}}, {});
  EXPECT_EQ(map.nearest(centre), &map.surfels()[0]);
  map.add(std::vector<Surfel>{{Point(0.25F, 0.05F), Point(1.0F, 0.0F), true}}, {});
  EXPECT_EQ(map.nearest({0.25F, 0.05F}), &map.surfels()[3]);
}

TEST(SurfelMap, IsEmptyAndElsewhereOnceItIsReset) {
  std::mt19937 random(3);
  SurfelMap map(0.35), fresh(0.35);
  map.reset({0.0F, 0.0F}, 3.0);
  map.add(scattered_surfels(60, random), {});
  ASSERT_GT(std::ranges::count_if(found_everywhere(map), [](auto i) { return i >= 0; }), 500);
  for (SurfelMap* const each : {&map, &fresh}) {
    each->reset({0.4F, -0.7F}, 2.5);
    EXPECT_TRUE(each->surfels().empty());
    EXPECT_EQ(each->nearest({0.0F, 0.0F}), nullptr);
    std::mt19937 again(4);
    each->add(scattered_surfels(60, again), {1.0, 0.5, 0.3});
  }
  EXPECT_EQ(map.origin(), fresh.origin());
  EXPECT_NEAR(map.width_m(), 5.0, 1e-6);
  EXPECT_EQ(found_everywhere(map), found_everywhere(fresh));
}

}  // namespace
}  // namespace topo::slam

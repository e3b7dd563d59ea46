// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/scan_groups.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <memory>

#include "tests/unit/core/motion/surroundings.hpp"

namespace topo::perception {
namespace {

using motion::empty_scan;

using types::Vector2;

/// A wall all around at five metres, and what is put before it.
struct View {
  std::unique_ptr<types::Scan> scan = empty_scan(types::stamp_from_seconds(1.0));
  std::unique_ptr<ScanLook> look = std::make_unique<ScanLook>();
  std::array<ScanGroup, 8> groups{};
  View() { scan->range_m.fill(5.0F); }
  void put(double range_m, double from_degrees, double to_degrees) {
    for (std::size_t i = 0; i < scan->beams; ++i) {
      const double degrees = static_cast<double>(scan->angle_rad(i)) / types::kDegree_rad;
      if (degrees >= from_degrees && degrees <= to_degrees) scan->range_m[i] = static_cast<float>(range_m);
    }
  }
  std::size_t find() {
    EXPECT_TRUE(take_look(*scan, 0.0, *look));
    return find_groups(*look, {}, groups);
  }
};

TEST(ScanGroups, APersonStandsFree) {
  View view;
  view.put(2.0, 10.0, 20.0);
  ASSERT_EQ(view.find(), 1U);
  const ScanGroup& g = view.groups[0];
  EXPECT_TRUE(g.begins_freely && g.ends_freely);
  EXPECT_NEAR(g.centre.norm(), 2.0, 0.01);
  EXPECT_NEAR(std::atan2(g.centre.y(), g.centre.x()), 15.0 * types::kDegree_rad, 0.01);
  EXPECT_NEAR(g.radius_m, 0.175, 0.02);
}

TEST(ScanGroups, TwoLegsAreOneAndWhatIsBetweenIsNotOfIt) {
  View view;
  view.put(2.0, 10.0, 13.0);
  view.put(2.05, 18.0, 21.0);
  ASSERT_EQ(view.find(), 1U);
  EXPECT_LT(view.groups[0].radius_m, 0.25);
  std::size_t far = 0;
  for_each_point(*view.look, view.groups[0], [&](const Vector2& p) { far += p.norm() > 3.0 ? 1U : 0U; });
  EXPECT_EQ(far, 0U);
}

TEST(ScanGroups, OfWhatIsHalfHiddenOneEndIsFree) {
  View view;
  view.put(3.0, 10.0, 20.0);
  view.put(1.5, 15.0, 60.0);
  ASSERT_EQ(view.find(), 1U);
  EXPECT_TRUE(view.groups[0].begins_freely);
  EXPECT_FALSE(view.groups[0].ends_freely);
}

TEST(ScanGroups, WhatIsHiddenOnBothSidesLargeFarOrASpeckIsNone) {
  View hidden, large, far, speck;
  hidden.put(1.5, -40.0, 0.0);
  hidden.put(1.5, 10.0, 50.0);
  EXPECT_EQ(hidden.find(), 0U) << "a piece of wall through a gap";
  large.put(3.0, -20.0, 20.0);
  EXPECT_EQ(large.find(), 0U);
  far.scan->range_m.fill(20.0F);
  far.put(7.0, 0.0, 4.0);
  EXPECT_EQ(far.find(), 0U);
  speck.put(2.0, 0.0, 0.3);
  EXPECT_EQ(speck.find(), 0U);
}

TEST(ScanGroups, FindsNoMoreThanThereIsRoomFor) {
  View view;
  for (int i = 0; i < 20; ++i) view.put(3.0, -100.0 + 10.0 * i, -97.0 + 10.0 * i);
  EXPECT_EQ(view.find(), view.groups.size());
}

TEST(ScanGroups, OfTheMirroredViewAreTheMirroredOnes) {
  EXPECT_TRUE(rc::check([] {
    View view;
    for (int people = 0; people < 4; ++people) {
      const double range_m = *rc::gen::inRange(11, 45) * 0.1;
      const double at = -120.0 + 60.0 * people + *rc::gen::inRange(0, 20);
      view.put(range_m, at, at + *rc::gen::inRange(3, 20));
      // Something that hides its beginning.
      if (*rc::gen::inRange(0, 3) == 0) view.put(0.6 * range_m, at - 4.0, at + 1.0);
    }
    const std::size_t found = view.find();
    const std::array<ScanGroup, 8> groups = view.groups;
    std::reverse(view.scan->range_m.begin(), view.scan->range_m.begin() + view.scan->beams);
    RC_ASSERT(view.find() == found);
    for (std::size_t i = 0; i < found; ++i) {
      const ScanGroup &a = groups[i], &b = view.groups[found - 1 - i];
      RC_ASSERT((a.centre - Vector2(b.centre.x(), -b.centre.y())).norm() < 1e-4);
      RC_ASSERT((a.begin - Vector2(b.end.x(), -b.end.y())).norm() < 1e-4);
      RC_ASSERT(a.begins_freely == b.ends_freely);
      RC_ASSERT(a.ends_freely == b.begins_freely);
      RC_ASSERT(std::abs(a.radius_m - b.radius_m) < 1e-4);
      RC_ASSERT(a.first == view.scan->beams - 1 - b.last);
    }
  }));
}

TEST(ScanGroups, HoldTheirHitsWithinTheirCircle) {
  EXPECT_TRUE(rc::check([] {
    View view;
    for (int things = 0; things < 8; ++things) {
      const double at = -130.0 + 30.0 * things + *rc::gen::inRange(0, 10);
      view.put(*rc::gen::inRange(10, 70) * 0.1, at, at + *rc::gen::inRange(1, 15));
    }
    const std::size_t found = view.find();
    std::size_t after = 0;
    for (std::size_t i = 0; i < found; ++i) {
      const ScanGroup& group = view.groups[i];
      RC_ASSERT(group.first >= after);
      after = group.last + 1;
      RC_ASSERT((group.begins_freely || group.ends_freely));
      double farthest_m = 0.0;
      for_each_point(*view.look, group, [&](const Vector2& p) {
        farthest_m = std::max(farthest_m, (p - group.centre).norm());
        RC_ASSERT(p.norm() <= group.farthest_m + 1e-6);
      });
      RC_ASSERT(std::abs(farthest_m - group.radius_m) < 1e-12);
      RC_ASSERT(group.radius_m <= ScanGroupParams{}.across_m);
    }
  }));
}

}  // namespace
}  // namespace topo::perception

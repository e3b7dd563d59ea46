// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/types/geometry.hpp"
#include "core/types/result.hpp"
#include "core/types/scan.hpp"
#include "core/types/stamp.hpp"

namespace topo::types {
namespace {

TEST(Scan, OnlyDistancesAreHits) {
  EXPECT_TRUE(is_hit(0.5F));
  EXPECT_FALSE(is_hit(kNoReturn));
  EXPECT_FALSE(is_hit(kTooNear));
  EXPECT_FALSE(is_hit(kInvalid));
}

TEST(Scan, BeamsRunCounterClockwiseFromTheMinimum) {
  Scan scan;
  scan.beams = 3;
  scan.geometry.angle_min_rad = -0.5F;
  scan.geometry.angle_increment_rad = 0.25F;
  EXPECT_FLOAT_EQ(scan.angle_rad(2), 0.0F);
  EXPECT_EQ(scan.ranges().size(), 3U);
  EXPECT_DOUBLE_EQ(scan.beam_at(0.0), 2.0);
  EXPECT_DOUBLE_EQ(scan.beam_at(-0.625), -0.5) << "outside its sector";
  scan.geometry.angle_increment_rad = -0.25F;  // mounted upside down
  EXPECT_DOUBLE_EQ(scan.beam_at(static_cast<double>(scan.angle_rad(2))), 2.0);
}

TEST(Stamp, SecondsThereAndBack) {
  EXPECT_EQ(stamp_from_seconds(1.5).time_since_epoch(), std::chrono::milliseconds(1500));
  EXPECT_DOUBLE_EQ(to_seconds(stamp_from_seconds(-0.25)), -0.25);
}

TEST(Result, CarriesWhatWasFound) {
  const Result<int> bad = fail(Errc::kNotFound, "/dev/ttyUSB0: no such device", 2);
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().code, Errc::kNotFound);
  EXPECT_EQ(bad.error().sys_errno, 2);
  const Result<int> good = 3;
  EXPECT_EQ(*good, 3);
}

TEST(Rectangle, GrowsFromEmpty) {
  Rectangle r;
  EXPECT_TRUE(r.empty());
  EXPECT_FALSE(r.contains({0.0, 0.0}));
  r.extend({1.0, -2.0});
  EXPECT_FALSE(r.empty());
  r.extend({-1.0, 2.0});
  EXPECT_TRUE(r.contains({0.0, 0.0}));
  EXPECT_FALSE(r.contains({0.0, 2.1}));
}

TEST(Rectangle, IsTheSmallestAroundItsPoints) {
  EXPECT_TRUE(rc::check([] {
    const auto coordinates = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::pair<int, int>>>(
        rc::gen::pair(rc::gen::inRange(-50, 50), rc::gen::inRange(-50, 50))));
    Rectangle r, backwards;
    for (const auto& [x, y] : coordinates) r.extend({x, y});
    for (auto p = coordinates.rbegin(); p != coordinates.rend(); ++p) backwards.extend({p->first, p->second});
    RC_ASSERT(r.min == backwards.min);
    RC_ASSERT(r.max == backwards.max);
    const auto touches = [&](const auto& side) {
      return std::any_of(coordinates.begin(), coordinates.end(), side);
    };
    for (const auto& [x, y] : coordinates) RC_ASSERT(r.contains({x, y}));
    RC_ASSERT(touches([&](const auto& p) { return p.first == r.min.x(); }));
    RC_ASSERT(touches([&](const auto& p) { return p.first == r.max.x(); }));
    RC_ASSERT(touches([&](const auto& p) { return p.second == r.min.y(); }));
    RC_ASSERT(touches([&](const auto& p) { return p.second == r.max.y(); }));
    RC_ASSERT(!r.contains({r.max.x() + 0.5, r.min.y()}));
    RC_ASSERT(!r.contains({r.min.x(), r.min.y() - 0.5}));
  }));
}

TEST(Segment, LengthIsThatBetweenItsEnds) {
  EXPECT_EQ(Segment{}.length_m(), 0.0);
  EXPECT_DOUBLE_EQ((Segment{{1.0, 1.0}, {4.0, -3.0}}).length_m(), 5.0);
  EXPECT_DOUBLE_EQ((Segment{{4.0, -3.0}, {1.0, 1.0}}).length_m(), 5.0);
}

TEST(Stamp, SecondsKeepOrderAndSums) {
  EXPECT_TRUE(rc::check([] {
    const auto any_ms = [] { return std::chrono::milliseconds(*rc::gen::inRange(-1000000, 1000000)); };
    const Duration a = any_ms(), b = any_ms();
    RC_ASSERT((to_seconds(a) < to_seconds(b)) == (a < b));
    RC_ASSERT(std::abs(to_seconds(a + b) - (to_seconds(a) + to_seconds(b))) < 1e-9);
    const Duration back = from_seconds(to_seconds(a)) - a;
    RC_ASSERT(std::abs(back.count()) <= 1);  // towards zero
    RC_ASSERT(to_seconds(Stamp{a}) == to_seconds(a));
  }));
}

TEST(Result, AStatusIsGoodUntilItFails) {
  const Status good;
  EXPECT_TRUE(good.has_value());
  const Status bad = fail(Errc::kTimeout, "no answer");
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().message, "no answer");
  EXPECT_EQ(bad.error().sys_errno, 0);
  EXPECT_EQ(Error{}.code, Errc::kIo) << "by default the general one";
}

TEST(Result, AnErrorPassesThroughAndAValueIsUsed) {
  const auto half = [](int value) -> Result<int> {
    if (value % 2 != 0) return fail(Errc::kInvalidInput, "odd");
    return value / 2;
  };
  const auto more = [&](int value) { return half(value).transform([](int v) { return v + 1; }); };
  EXPECT_EQ(more(12).value_or(-1), 7);
  EXPECT_EQ(more(7).value_or(-1), -1);
  EXPECT_EQ(more(7).error().message, "odd");
  EXPECT_EQ(more(7).error().code, Errc::kInvalidInput);
}

}  // namespace
}  // namespace topo::types
